#include "workbench/commands/options/foreign_grasp_options.h"

#include <cmath>

#include "workbench/command.h"

namespace graspbench {

void ForeignGraspOptions::AddTo(Command& command) {
  std::vector<std::string> formats = {"auto"};
  for (const GraspFormat& format : ListGraspFormats()) formats.emplace_back(format.id);
  command.AddRequired("files", paths_, "grasp files, or folders (all files below them)", "FILES..");
  command.AddOption("--format", format_, "one of " + ListNames(formats), "NAME")->ShowDefault();
  command.AddOption("--hand-frame", read_.hand_frame,
                    "link of the hand whose pose the files give, if they do not state it reliably",
                    "LINK");
  command.AddOption("--object-frame", read_.object_frame,
                    "frame of the poses: \"mesh\", the frame of the object's mesh", "NAME");
  command
      .AddOption("--joint-names", read_.joint_names,
                 "joint names in the order of the positions, for files without names", "NAME,..")
      ->SplitAtCommas()
      ->OneValueEach();
  command
      .AddOption("--open", open_joints_,
                 "joints of the open hand in radians and metres, for files without joints",
                 "NAME=NUMBER,..")
      ->SplitAtCommas()
      ->OneValueEach();
  command.AddOption("--scale", scale_, "scale of the object's mesh, overriding the files",
                    "NUMBER");
}

GraspCollection ForeignGraspOptions::Read() const {
  GraspReadOptions options = read_;
  if (scale_) {
    if (!(*scale_ > 0.0) || !std::isfinite(*scale_)) {
      throw Error(ErrorKind::kUsage, "--scale: expected a number above 0, 0.001 for a mesh in mm");
    }
    options.scale = scale_;
  }
  for (const std::string& joint : open_joints_) {
    const size_t sign = joint.rfind('=');
    double position = 0.0;
    if (sign == std::string::npos || !ReadNumber(joint.substr(sign + 1), position) ||
        !std::isfinite(position)) {
      throw Error(ErrorKind::kUsage, "--open \"" + joint + "\": expected NAME=NUMBER");
    }
    options.open_joints.emplace_back(joint.substr(0, sign), position);
  }
  return ReadGraspCollection(paths_, format_, options);
}

void GraspInputOptions::AddTo(Command& command) {
  grasps_.AddTo(command);
  command.AddOption("--hand", hand_, "hand by id or folder", "HAND")->ShowDefault();
  command.AddOption("--objects", objects_,
                    "folder of the meshes; an object is found by every end of its path", "DIR");
}

GraspInputs GraspInputOptions::Load(const std::vector<FreeSpaceProfile>& profiles) const {
  return LoadGraspInputs(grasps_.Read(), hand_, objects_, profiles);
}

}  // namespace graspbench
