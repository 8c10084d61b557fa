#include "workbench/commands/options/foreign_grasp_options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "workbench/commands/command.h"

namespace graspbench {

void ForeignGraspOptions::AddTo(CLI::App& command) {
  std::vector<std::string> formats = {"auto"};
  for (const GraspFormat& format : ListGraspFormats()) formats.emplace_back(format.id);
  command.add_option("files", paths_, "files of grasps, or folders: all files below them")
      ->required()
      ->option_text("FILES..");
  command.add_option("--format", format_, "one of " + ListNames(formats))
      ->option_text("NAME")
      ->capture_default_str();
  command
      .add_option("--hand-frame", read_.hand_frame,
                  "link of the hand whose pose the files give, where they do not say it reliably")
      ->option_text("LINK");
  command
      .add_option("--object-frame", read_.object_frame,
                  "frame in which the poses are given: \"mesh\", as the object's mesh is drawn")
      ->option_text("NAME");
  command
      .add_option("--joint-names", read_.joint_names,
                  "joints in the order of the files' positions, where they have no names")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME,..");
  command
      .add_option("--open", open_joints_,
                  "joints of the open hand in radians and metres, where the files state none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME=NUMBER,..");
  command.add_option("--scale", scale_, "of the object's mesh, instead of what the files say")
      ->option_text("NUMBER");
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
    if (sign == std::string::npos || !CLI::detail::lexical_cast(joint.substr(sign + 1), position) ||
        !std::isfinite(position)) {
      throw Error(ErrorKind::kUsage, "--open \"" + joint + "\": expected NAME=NUMBER");
    }
    options.open_joints.emplace_back(joint.substr(0, sign), position);
  }
  return ReadGraspCollection(paths_, format_, options);
}

void GraspInputOptions::AddTo(CLI::App& command) {
  grasps_.AddTo(command);
  command.add_option("--hand", hand_, "hand by id or folder")
      ->option_text("HAND")
      ->capture_default_str();
  command
      .add_option("--objects", objects_,
                  "folder of the meshes; a grasp's object is looked for by every end of its path")
      ->option_text("DIR");
}

GraspInputs GraspInputOptions::Load(const std::vector<FreeSpaceProfile>& profiles) const {
  return LoadGraspInputs(grasps_.Read(), hand_, objects_, profiles);
}

}  // namespace graspbench
