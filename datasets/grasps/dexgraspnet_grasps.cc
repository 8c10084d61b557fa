// DexGraspNet: a list of dictionaries, one a grasp, saved by np.save; the file's name is the
// object's. Source: README and grasp_generation of PKU-EPIC/DexGraspNet. Its joints count from 0
// where the maker's count from 1 (map_to_hand.h): the record keeps the file's names, and mapping
// translates.

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/map_to_hand.h"
#include "datasets/grasps/pose_numbers.h"
#include "datasets/grasps/python_values.h"

namespace graspbench {
namespace {

// Six numbers of the root, 22 joints: what a grasp takes at least, when its keys are shared.
constexpr size_t kFewestBytes = 28 * 2;

double GetNumber(const PickleValue& dict, const std::string& key, const std::string& where) {
  const PickleValue* value = FindItem(dict, key);
  if (!value) throw Error(ErrorKind::kFormat, where + " has no " + key);
  return ReadNumber(*value, where + "." + key);
}

/** Everything in `qpos` has a name that is known. */
void RefuseUnknownJoints(const PickleValue& qpos, const std::string& where) {
  std::vector<std::string> known = {"WRJTx", "WRJTy", "WRJTz", "WRJRx", "WRJRy", "WRJRz"};
  for (const DexgraspnetJoint& joint : ListDexgraspnetJoints()) known.push_back(joint.name);
  for (size_t i = 0; i + 1 < qpos.items.size(); i += 2) {
    const std::string name = ReadText(*qpos.items[i], where + ", a key");
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(ErrorKind::kFormat, where + ": the hand of DexGraspNet has no joint \"" + name +
                                          "\"" + SuggestNames(name, known));
    }
  }
}

ForeignGrasp ReadDexgraspnetGrasp(const PickleValue& dict, const std::string& file, size_t index,
                                  const GraspReadOptions& options) {
  const std::string where = fmt::format("{}: grasp {}", file, index);
  if (dict.kind != PickleValue::Kind::kDict) {
    throw Error(ErrorKind::kFormat,
                where + " is " + DescribeValue(dict) + ", expected a dictionary");
  }
  const PickleValue* found = FindItem(dict, "qpos");
  if (!found || Unwrap(*found).kind != PickleValue::Kind::kDict) {
    throw Error(ErrorKind::kFormat, where + " has no qpos, a dictionary of positions by name");
  }
  const PickleValue& qpos = Unwrap(*found);
  const std::string here = where + ", qpos";
  RefuseUnknownJoints(qpos, here);
  const auto get = [&](const char* key) { return GetNumber(qpos, key, here); };

  GraspStage stage;
  stage.name = "grasp";
  stage.X_OR = SettlePose(MakePose(MakeRotationRpy(get("WRJRx"), get("WRJRy"), get("WRJRz")),
                                   {get("WRJTx"), get("WRJTy"), get("WRJTz")}));
  ForeignGrasp grasp;
  for (const DexgraspnetJoint& joint : ListDexgraspnetJoints()) {
    grasp.joint_names.push_back(joint.name);
    stage.joints.push_back(get(joint.name.c_str()));
  }
  grasp.stages.push_back(std::move(stage));
  grasp.hand = "shadow";
  grasp.root_link = "palm";
  grasp.object = std::filesystem::path(file).stem().string();
  grasp.scale = options.scale ? *options.scale : GetNumber(dict, "scale", where);
  if (!(grasp.scale > 0.0)) {
    throw Error(ErrorKind::kRange,
                fmt::format("{}.scale is {}, expected above 0", where, grasp.scale));
  }
  grasp.assumptions.push_back(
      "joints count from 0: robot0:FFJ3 is the maker's FFJ4; FFJ4, MFJ4, THJ2, THJ1 turn the other "
      "way round");
  grasp.assumptions.push_back("the little finger of DexGraspNet's hand is set 1.8 mm farther out");
  return grasp;
}

std::vector<ForeignGrasp> ReadDexgraspnet(std::string_view bytes, const std::string& file,
                                          const GraspReadOptions& options) {
  const Pickle pickle = ReadNpy(bytes, file);
  const PickleValue& root = Unwrap(*pickle.root);
  if (root.kind != PickleValue::Kind::kList && root.kind != PickleValue::Kind::kArray) {
    throw Error(ErrorKind::kFormat,
                file + " holds " + DescribeValue(root) + ", expected a list of dictionaries");
  }
  if (root.items.size() > bytes.size() / kFewestBytes) {
    throw Error(ErrorKind::kFormat, fmt::format("{}: {} grasps in {} bytes: the file lies", file,
                                                root.items.size(), bytes.size()));
  }
  std::vector<ForeignGrasp> grasps;
  for (const PickleValue* item : root.items) {
    grasps.push_back(ReadDexgraspnetGrasp(Unwrap(*item), file, grasps.size(), options));
  }
  return grasps;
}

bool RecognisesDexgraspnet(std::string_view bytes) {
  return !bytes.empty() && (bytes.front() == '\x93' || bytes.front() == '\x80') &&
         bytes.find("WRJTx") != std::string_view::npos;
}

}  // namespace

GraspFormat MakeDexgraspnetGraspFormat() {
  return {"dexgraspnet", "DexGraspNet: .npy of the Shadow Hand", RecognisesDexgraspnet,
          ReadDexgraspnet};
}

}  // namespace graspbench
