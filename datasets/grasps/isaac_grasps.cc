// isaac_grasp 1.0: YAML of one gripper and one object. Sources: the documentation of Isaac Sim's
// grasp editor (object_frame_link, gripper_frame_link) and of Isaac ROS (object_frame,
// gripper_frame), which warns against relying on the frames; later writers add object_file,
// object_scale and bite_point, and leave out the joints of a hand that a profile closes.

#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/base/text/yaml.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/pose_numbers.h"

namespace graspbench {
namespace {

constexpr char kMeshFrame[] = "mesh";

/** The text of a key in either spelling; empty: neither is there. */
std::string ReadFrame(YamlMap& map, const std::string& key) {
  std::string frame;
  for (const std::string& spelling : {key + "_link", key}) {
    if (map.Has(spelling)) map.Read(spelling, frame);
  }
  return frame;
}

void DemandFrames(const std::string& file, const std::string& hand_frame,
                  const std::string& object_frame, const GraspReadOptions& options) {
  std::string missing;
  const auto demand = [&](const std::string& given, const char* option, const std::string& found) {
    if (!given.empty()) return;
    missing += (missing.empty() ? "" : ", and ") + std::string(option) +
               (found.empty() ? "" : " (the file names \"" + found + "\")");
  };
  demand(options.hand_frame, "--hand-frame LINK of the hand", hand_frame);
  demand(options.object_frame, "--object-frame mesh where poses are given in the frame of the mesh",
         object_frame);
  if (!missing.empty()) {
    throw Error(ErrorKind::kUsage,
                file +
                    ": a file of isaac_grasp does not say reliably which frames its poses are "
                    "of; give " +
                    missing);
  }
  if (options.object_frame == kMeshFrame) return;
  throw Error(ErrorKind::kUsage, "--object-frame \"" + options.object_frame +
                                     "\": expected mesh, for poses in the frame of the object's "
                                     "mesh; those of another frame would have to be converted "
                                     "first");
}

/** Names and positions of a map of joints. */
bool ReadJoints(const YAML::Node& node, const std::string& file, const std::string& where,
                Diagnostics& problems, std::vector<std::string>& names,
                std::vector<double>& positions) {
  if (!node.IsMap() || node.size() == 0) {
    problems.Fail(file, LineOf(node), where + ": expected a map of joints and positions");
    return false;
  }
  for (const auto& entry : node) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    double position = 0.0;
    if (name.empty() || !entry.second.IsScalar() ||
        !YAML::convert<double>::decode(entry.second, position) || !std::isfinite(position)) {
      problems.Fail(file, LineOf(entry.second), where + ": expected a joint and a finite position");
      return false;
    }
    names.push_back(name);
    positions.push_back(position);
  }
  return true;
}

std::optional<Pose> ReadPose(YamlMap& map, const std::string& file, const std::string& where,
                             Diagnostics& problems) {
  const int before = problems.num_errors();
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), xyz = Eigen::Vector3d::Zero();
  double w = 1.0;
  map.Read("position", p);
  const YAML::Node orientation = map.Child("orientation");
  if (problems.num_errors() == before) {
    YamlMap quaternion(orientation, file, where + ", orientation", problems);
    quaternion.Read("w", w);
    quaternion.Read("xyz", xyz);
    quaternion.FinishKnownKeys();
  }
  if (problems.num_errors() > before) return std::nullopt;
  const double numbers[] = {p.x(), p.y(), p.z(), w, xyz.x(), xyz.y(), xyz.z()};
  try {
    return PoseFromNumbers(numbers, where);
  } catch (const Error& error) {
    problems.Fail(file, LineOf(orientation), error.what());
    return std::nullopt;
  }
}

/** Positions of the pre-grasp in the order of the grasp's joints. */
std::optional<std::vector<double>> SortLike(const std::vector<std::string>& wanted,
                                            const std::vector<std::string>& names,
                                            const std::vector<double>& positions) {
  std::vector<double> sorted;
  for (const std::string& name : wanted) {
    for (size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) sorted.push_back(positions[i]);
    }
  }
  if (sorted.size() != wanted.size() || names.size() != wanted.size()) return std::nullopt;
  return sorted;
}

void ReadIsaacGrasp(const YAML::Node& node, const std::string& file, const std::string& where,
                    Diagnostics& problems, ForeignGrasp& grasp) {
  YamlMap map(node, file, where, problems);
  double confidence = 1.0;
  map.Read("confidence", confidence, Needed::kNo);
  Eigen::Vector3d bite_point = Eigen::Vector3d::Zero();  // where jaws would meet: not used
  map.Read("bite_point", bite_point, Needed::kNo);
  const std::optional<Pose> X_OR = ReadPose(map, file, where, problems);
  std::vector<double> positions;
  const YAML::Node joints = map.Child("cspace_position", Needed::kNo);
  const YAML::Node pregrasp = map.Child("pregrasp_cspace_position", Needed::kNo);
  map.FinishKnownKeys();
  // A key without a value is there, but no map of joints.
  const bool has_joints = map.Has("cspace_position"),
             has_pregrasp = map.Has("pregrasp_cspace_position");
  if (has_joints && !ReadJoints(joints, file, where + ", cspace_position", problems,
                                grasp.joint_names, positions)) {
    return;
  }
  if (!X_OR) return;
  if (has_pregrasp) {
    std::vector<std::string> names;
    std::vector<double> unsorted;
    if (!ReadJoints(pregrasp, file, where + ", pregrasp_cspace_position", problems, names,
                    unsorted)) {
      return;
    }
    if (!has_joints) grasp.joint_names = names;
    const auto sorted = SortLike(grasp.joint_names, names, unsorted);
    if (!sorted) {
      problems.Fail(file, LineOf(pregrasp),
                    where + ": pregrasp_cspace_position is of other joints than cspace_position");
      return;
    }
    grasp.stages.push_back({"pregrasp", *X_OR, *sorted});
  }
  if (has_joints) grasp.stages.push_back({"grasp", *X_OR, positions});
  if (!has_joints && !has_pregrasp) grasp.stages.push_back({"pregrasp", *X_OR, {}});
}

std::vector<ForeignGrasp> ReadIsaac(std::string_view bytes, const std::string& file,
                                    const GraspReadOptions& options) {
  Diagnostics problems;
  const YAML::Node root = ParseYaml(std::string(bytes), file, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, file + " cannot be used");
  YamlMap map(root, file, "isaac_grasp", problems);
  std::string format, version;
  map.Read("format", format);
  map.Read("format_version", version);
  if (!format.empty() && format != "isaac_grasp") map.Fail("format", "expected isaac_grasp");
  if (!version.empty() && version != "1.0" && version != "1") {
    map.Fail("format_version", "is " + version + "; 1.0 is read");
  }
  const std::string hand_frame = ReadFrame(map, "gripper_frame");
  const std::string object_frame = ReadFrame(map, "object_frame");
  std::string object_file;
  double object_scale = 1.0;
  map.Read("object_file", object_file, Needed::kNo);
  map.Read("object_scale", object_scale, Needed::kNo);
  if (!(object_scale > 0.0 && std::isfinite(object_scale))) {
    map.Fail("object_scale", "expected a number above 0");
  }
  const bool has_scale = options.scale || map.Has("object_scale");
  const YAML::Node grasps = map.Child("grasps");
  std::vector<ForeignGrasp> made;
  std::set<std::string> names;
  if (!grasps.IsNull() && !grasps.IsMap()) map.Fail("grasps", "expected a map of grasps");
  if (grasps.IsMap()) {
    for (const auto& entry : grasps) {
      ForeignGrasp grasp;
      grasp.root_link = options.hand_frame;
      grasp.object = object_file.empty() ? object_frame : object_file;
      grasp.scale = options.scale.value_or(object_scale);
      if (!has_scale) grasp.assumptions.push_back("the mesh is drawn in metres, scale 1");
      grasp.assumptions.push_back("poses are given in the frame of the mesh");
      const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (!names.insert(name).second) {
        problems.Fail(file, LineOf(entry.first), "grasp " + name + " is there twice");
      }
      ReadIsaacGrasp(entry.second, file, "grasp " + name, problems, grasp);
      made.push_back(std::move(grasp));
    }
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, file + " cannot be used");
  DemandFrames(file, hand_frame, object_frame, options);
  return made;
}

bool RecognisesIsaac(std::string_view bytes) {
  return bytes.find("isaac_grasp") != std::string_view::npos && !bytes.empty() &&
         bytes.front() != '\x93' && bytes.front() != '\x80';
}

}  // namespace

GraspFormat MakeIsaacGraspFormat() {
  return {"isaac", "isaac_grasp 1.0: .yaml of any gripper", RecognisesIsaac, ReadIsaac};
}

}  // namespace graspbench
