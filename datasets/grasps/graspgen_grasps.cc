// GraspGen: JSON of one object, poses of a gripper's base as 4 x 4 matrices, with verdicts; joints
// are the gripper's own affair. Source: docs of NVlabs/GraspGen, "GRASP_DATASET_FORMAT".

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/pose_numbers.h"

namespace graspbench {
namespace {

constexpr double kRotationTolerance = 1e-3;

Pose ReadMatrix(const Json& json, const std::string& where) {
  if (!json.is_array() || json.size() != 4) {
    throw Error(ErrorKind::kFormat, where + ": expected 4 rows of 4 numbers");
  }
  Eigen::Matrix4d m;
  for (size_t row = 0; row < 4; ++row) {
    const auto numbers = ReadJsonNumbers(json[row], fmt::format("{}[{}]", where, row), 4);
    m.row(static_cast<Eigen::Index>(row)) = Eigen::Map<const Eigen::RowVector4d>(numbers.data());
  }
  const Eigen::Matrix3d R = m.topLeftCorner<3, 3>();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > kRotationTolerance || R.determinant() < 0.0 ||
      (m.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > kRotationTolerance) {
    throw Error(ErrorKind::kRange,
                fmt::format("{} is not a pose: its rows are {} off a rotation with the last row "
                            "0 0 0 1 (expected at most {}), or it is a mirror",
                            where, off, kRotationTolerance));
  }
  return SettlePose(MakePose(R, m.topRightCorner<3, 1>()));
}

std::vector<ForeignGrasp> ReadGraspgen(std::string_view bytes, const std::string& file,
                                       const GraspReadOptions& options) {
  const Json json = ParseJsonObject(bytes, file);
  const Json& object = GetJson(json, "object", file);
  const Json& mesh = GetJson(object, "file", file + ": object");
  const Json& scale = GetJson(object, "scale", file + ": object");
  if (!mesh.is_string()) throw Error(ErrorKind::kFormat, file + ": object.file: expected a text");
  if (!scale.is_number() || !(scale.get<double>() > 0.0)) {
    throw Error(ErrorKind::kFormat, file + ": object.scale: expected a number above 0");
  }
  const Json& grasps = GetJson(json, "grasps", file);
  const Json& transforms = GetJson(grasps, "transforms", file + ": grasps");
  if (!transforms.is_array()) {
    throw Error(ErrorKind::kFormat, file + ": grasps.transforms: expected a list");
  }
  std::vector<bool> labels;
  if (grasps.contains("object_in_gripper")) {
    labels = ReadJsonLabels(grasps["object_in_gripper"], file + ": grasps.object_in_gripper",
                            transforms.size());
  }
  if (options.hand_frame.empty()) {
    throw Error(ErrorKind::kUsage,
                file +
                    ": the file gives poses of the gripper's base; give its link in the hand by "
                    "--hand-frame LINK");
  }
  std::vector<ForeignGrasp> made;
  for (size_t i = 0; i < transforms.size(); ++i) {
    ForeignGrasp grasp;
    grasp.root_link = options.hand_frame;
    grasp.object = mesh.get<std::string>();
    grasp.scale = options.scale.value_or(scale.get<double>());
    if (!labels.empty()) grasp.label = labels[i];
    grasp.stages.push_back(
        {"pregrasp",
         ReadMatrix(transforms[i], fmt::format("{}: grasps.transforms[{}]", file, i)),
         {}});
    made.push_back(std::move(grasp));
  }
  return made;
}

bool RecognisesGraspgen(std::string_view bytes) {
  return bytes.find("\"transforms\"") != std::string_view::npos &&
         bytes.find("\"object\"") != std::string_view::npos;
}

}  // namespace

GraspFormat MakeGraspgenGraspFormat() {
  return {"graspgen", "GraspGen: .json of any gripper, poses alone", RecognisesGraspgen,
          ReadGraspgen};
}

}  // namespace graspbench
