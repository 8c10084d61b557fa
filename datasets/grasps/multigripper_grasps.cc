// MultiGripperGrasp: JSON of one gripper and one object, joints without names. Source: the data
// format in the manual of IRVLUTD/isaac_sim_grasping.

#include <fmt/core.h>

#include "core/base/error.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/multigripper_table.h"
#include "datasets/grasps/pose_numbers.h"

namespace graspbench {
namespace {

constexpr size_t kNumPoseNumbers = 7;

std::string ReadJsonText(const Json& json, const std::string& key, const std::string& file) {
  const Json& text = GetJson(json, key, file);
  if (!text.is_string()) throw Error(ErrorKind::kFormat, file + ": " + key + ": expected a text");
  return text.get<std::string>();
}

/** Rows of positions, one for each grasp. */
std::vector<std::vector<double>> ReadPositions(const Json& json, const std::string& where,
                                               size_t num_grasps,
                                               const std::vector<std::string>& joint_names) {
  if (!json.is_array() || json.size() != num_grasps) {
    throw Error(ErrorKind::kFormat,
                fmt::format("{}: expected a list of {}, one for each pose", where, num_grasps));
  }
  std::vector<std::vector<double>> positions;
  for (const Json& row : json) {
    const std::string here = fmt::format("{}[{}]", where, positions.size());
    positions.push_back(ReadJsonNumbers(row, here));
    if (positions.back().size() == joint_names.size()) continue;
    throw Error(joint_names.empty() ? ErrorKind::kUsage : ErrorKind::kFormat,
                fmt::format("{}: {} positions without names, {} names by --joint-names; name the "
                            "joints in the order of the simulator that wrote the file",
                            here, positions.back().size(), joint_names.size()));
  }
  return positions;
}

std::vector<ForeignGrasp> ReadMultigripper(std::string_view bytes, const std::string& file,
                                           const GraspReadOptions& options) {
  const Json json = ParseJsonObject(bytes, file);
  const std::string gripper = ReadJsonText(json, "gripper", file);
  const std::string object =
      ReadJsonText(json, json.contains("object_id") ? "object_id" : "object_ID", file);
  const Json& poses = GetJson(json, "pose", file);
  if (!poses.is_array()) throw Error(ErrorKind::kFormat, file + ": pose: expected a list of poses");
  if (options.hand_frame.empty()) {
    throw Error(ErrorKind::kUsage, file + ": the file does not name the link of " + gripper +
                                       " whose pose it gives; give --hand-frame LINK");
  }
  std::vector<std::pair<const char*, std::vector<std::vector<double>>>> stages;
  for (const auto& [key, stage] :
       {std::pair{"dofs", "pregrasp"}, std::pair{"final_dofs", "grasp"}}) {
    if (!json.contains(key)) continue;
    stages.emplace_back(
        stage, ReadPositions(json[key], file + ": " + key, poses.size(), options.joint_names));
  }
  const MultigripperGripper* table = FindMultigripperGripper(gripper);
  const bool is_open = stages.empty() && table != nullptr && !options.joint_names.empty();
  if (is_open) {
    if (table->open.size() != options.joint_names.size()) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("{}: {} has {} joints, {} names by --joint-names; name the joints in "
                              "the order of the simulator that wrote the file",
                              file, gripper, table->open.size(), options.joint_names.size()));
    }
    stages.emplace_back("pregrasp", std::vector<std::vector<double>>(poses.size(), table->open));
  }
  std::vector<bool> labels;
  if (json.contains("result")) {
    labels = ReadJsonLabels(json["result"], file + ": result", poses.size());
  }

  std::vector<ForeignGrasp> grasps;
  for (size_t i = 0; i < poses.size(); ++i) {
    const std::string where = fmt::format("{}: pose[{}]", file, i);
    const Pose X_OR =
        PoseFromNumbers(ReadJsonNumbers(poses[i], where, kNumPoseNumbers).data(), where);
    ForeignGrasp grasp;
    grasp.hand = gripper;
    grasp.root_link = options.hand_frame;
    grasp.object = object;
    grasp.scale = options.scale.value_or(1.0);
    grasp.assumptions.push_back("quaternions are w x y z");
    if (!options.scale) grasp.assumptions.push_back("the mesh is drawn in metres, scale 1");
    if (is_open) grasp.assumptions.push_back("joints open as MultiGripperGrasp's table has them");
    if (!labels.empty()) grasp.label = labels[i];
    for (const auto& [stage, positions] : stages) {
      grasp.joint_names = options.joint_names;
      grasp.stages.push_back({stage, X_OR, positions[i]});
    }
    if (stages.empty()) grasp.stages.push_back({"pregrasp", X_OR, {}});
    grasps.push_back(std::move(grasp));
  }
  return grasps;
}

bool RecognisesMultigripper(std::string_view bytes) {
  return bytes.find("\"gripper\"") != std::string_view::npos &&
         bytes.find("\"pose\"") != std::string_view::npos;
}

}  // namespace

GraspFormat MakeMultigripperGraspFormat() {
  return {"multigripper", "MultiGripperGrasp: .json of any gripper", RecognisesMultigripper,
          ReadMultigripper};
}

}  // namespace graspbench
