// DexGraspBench (BODex, Dexonomy, DexLearn): a dictionary of numpy arrays, saved by np.save.
// Sources: README and src/task of DexGraspBench (evaluation, convert_format), dexonomy/op
// (gen_grasp, eval_data).

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/map_to_hand.h"
#include "datasets/grasps/pose_numbers.h"
#include "datasets/grasps/python_values.h"

namespace graspbench {
namespace {

constexpr int64_t kPoseSize = 7;
const std::array<const char*, 3> kStages = {"pregrasp", "grasp", "squeeze"};

/** The dictionary of one file. */
class GraspDict {
 public:
  GraspDict(const PickleValue& dict, std::string file) : dict_(&dict), file_(std::move(file)) {}

  std::string WhereIs(const std::string& key) const { return file_ + ": " + key; }
  const PickleValue* Find(const std::string& key) const { return FindItem(*dict_, key); }
  const PickleValue& Get(const std::string& key) const {
    const PickleValue* value = Find(key);
    if (!value) {
      throw Error(ErrorKind::kFormat, file_ + " has no " + key +
                                          "; a grasp of DexGraspBench has pregrasp_qpos, "
                                          "grasp_qpos, squeeze_qpos and obj_scale");
    }
    return *value;
  }
  NumberTable GetRows(const std::string& key, int64_t num_columns) const {
    NumberTable rows = ReadNumbers(Get(key), WhereIs(key));
    if (rows.num_dimensions == 0 || rows.num_columns != num_columns || rows.num_rows == 0) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{} has {} row(s) of {} number(s), expected rows of {}", WhereIs(key),
                              rows.num_rows, rows.num_columns, num_columns));
    }
    return rows;
  }
  /** Of all grasps, or one for each. */
  NumberTable GetRowsFor(const std::string& key, int64_t num_columns, int64_t num_grasps) const {
    NumberTable rows = GetRows(key, num_columns);
    if (rows.num_rows != 1 && rows.num_rows != num_grasps)
      FailCount(key, rows.num_rows, num_grasps);
    return rows;
  }
  std::vector<double> GetNumbersFor(const std::string& key, int64_t num_grasps) const {
    const NumberTable table = ReadNumbers(Get(key), WhereIs(key));
    const auto count = static_cast<int64_t>(table.numbers.size());
    if (count != 1 && count != num_grasps) FailCount(key, count, num_grasps);
    std::vector<double> numbers = table.numbers;
    if (count == 1) numbers.resize(static_cast<size_t>(num_grasps), numbers.front());
    return numbers;
  }
  [[noreturn]] void FailCount(const std::string& key, int64_t count, int64_t num_grasps) const {
    throw Error(ErrorKind::kFormat, fmt::format("{} is of {} grasp(s), grasp_qpos of {}",
                                                WhereIs(key), count, num_grasps));
  }

 private:
  const PickleValue* dict_;
  std::string file_;
};

/** What Dexonomy keeps of the object in scene_cfg: scene: {NAME: {scale, pose, file_path}}, task:
{obj_name: NAME}. */
struct SceneObject {
  std::string path;
  std::optional<double> scale;
  std::optional<Pose> X_WO;
};

SceneObject ReadSceneObject(const GraspDict& dict) {
  SceneObject object;
  const PickleValue* config = dict.Find("scene_cfg");
  const PickleValue* task = config ? FindItem(Unwrap(*config), "task") : nullptr;
  const PickleValue* scene = config ? FindItem(Unwrap(*config), "scene") : nullptr;
  const PickleValue* name = task ? FindItem(Unwrap(*task), "obj_name") : nullptr;
  if (!scene || !name) return object;
  const std::string where = dict.WhereIs("scene_cfg");
  const std::string key = ReadText(*name, where + ".task.obj_name");
  const PickleValue* found = FindItem(Unwrap(*scene), key);
  if (!found) throw Error(ErrorKind::kFormat, where + " has no object \"" + key + "\"");
  const std::string of_object = where + ".scene." + key;
  if (const PickleValue* path = FindItem(*found, "file_path")) {
    object.path = ReadText(*path, of_object + ".file_path");
  }
  if (const PickleValue* scale = FindItem(*found, "scale")) {
    const NumberTable table = ReadNumbers(*scale, of_object + ".scale");
    if (table.numbers.empty() ||
        std::any_of(table.numbers.begin(), table.numbers.end(),
                    [&](double number) { return number != table.numbers.front(); })) {
      throw Error(ErrorKind::kUnsupported,
                  of_object + ".scale differs between the axes; one number is expected");
    }
    object.scale = table.numbers.front();
  }
  if (const PickleValue* pose = FindItem(*found, "pose")) {
    const NumberTable table = ReadNumbers(*pose, of_object + ".pose");
    if (table.numbers.size() != static_cast<size_t>(kPoseSize)) {
      throw Error(ErrorKind::kFormat, of_object + ".pose is not of 7 numbers");
    }
    object.X_WO = PoseFromNumbers(table.row(0), of_object + ".pose");
  }
  return object;
}

std::string FindObjectPath(const GraspDict& dict, const SceneObject& scene) {
  for (const char* key : {"obj_path", "obj_name"}) {
    if (const PickleValue* value = dict.Find(key)) return ReadText(*value, dict.WhereIs(key));
  }
  if (!scene.path.empty()) return scene.path;
  const PickleValue* value = dict.Find("scene_path");
  return value ? ReadText(*value, dict.WhereIs("scene_path")) : std::string();
}

std::vector<double> FindScales(const GraspDict& dict, const SceneObject& scene,
                               const GraspReadOptions& options, int64_t num_grasps) {
  const auto count = static_cast<size_t>(num_grasps);
  if (options.scale) return std::vector<double>(count, *options.scale);
  if (!dict.Find("obj_scale") && scene.scale) return std::vector<double>(count, *scene.scale);
  if (!dict.Find("obj_scale") && dict.Find("scene_path")) {
    throw Error(ErrorKind::kFormat, dict.WhereIs("scene_path") +
                                        ": the object's scale stands in that file, which is not "
                                        "read; give it by --scale");
  }
  std::vector<double> scales = dict.GetNumbersFor("obj_scale", num_grasps);
  for (const double scale : scales) {
    if (!(scale > 0.0)) {
      throw Error(ErrorKind::kRange,
                  fmt::format("{} is {}, expected above 0", dict.WhereIs("obj_scale"), scale));
    }
  }
  return scales;
}

/** Poses of the object, one for all grasps or one for each; empty: the file has none. */
std::vector<Pose> FindObjectPoses(const GraspDict& dict, const SceneObject& scene,
                                  int64_t num_grasps) {
  std::vector<Pose> poses;
  if (dict.Find("obj_pose")) {
    const NumberTable rows = dict.GetRowsFor("obj_pose", kPoseSize, num_grasps);
    for (int64_t i = 0; i < rows.num_rows; ++i) {
      poses.push_back(PoseFromNumbers(rows.row(i), dict.WhereIs("obj_pose")));
    }
  } else if (scene.X_WO) {
    poses.push_back(*scene.X_WO);
  }
  return poses;
}

std::vector<ForeignGrasp> ReadDexgraspbench(std::string_view bytes, const std::string& file,
                                            const GraspReadOptions& options) {
  const Pickle pickle = ReadNpy(bytes, file);
  const PickleValue& root = Unwrap(*pickle.root);
  if (root.kind != PickleValue::Kind::kDict) {
    throw Error(ErrorKind::kFormat,
                file + " holds " + DescribeValue(root) + ", expected a dictionary");
  }
  const GraspDict dict(root, file);
  const std::vector<std::string>& joints = ListDexgraspbenchJoints();
  const auto num_columns = kPoseSize + static_cast<int64_t>(joints.size());
  std::vector<NumberTable> rows;
  for (const char* stage : kStages) {
    rows.push_back(dict.GetRows(std::string(stage) + "_qpos", num_columns));
  }
  const int64_t num_grasps = rows[1].num_rows;
  // Dexonomy keeps the way to one grasp as several rows of pregrasp_qpos, the farthest first.
  const bool is_way = num_grasps == 1 && rows[0].num_rows > 1;
  for (size_t s = 0; s < rows.size(); ++s) {
    if (rows[s].num_rows != num_grasps && !(s == 0 && is_way)) {
      dict.FailCount(std::string(kStages[s]) + "_qpos", rows[s].num_rows, num_grasps);
    }
  }

  const SceneObject scene = ReadSceneObject(dict);
  const std::string object = FindObjectPath(dict, scene);
  const std::vector<double> scales = FindScales(dict, scene, options, num_grasps);
  const std::vector<Pose> X_WOs = FindObjectPoses(dict, scene, num_grasps);
  std::vector<double> labels;
  if (dict.Find("succ_flag")) labels = dict.GetNumbersFor("succ_flag", num_grasps);

  std::vector<ForeignGrasp> grasps;
  for (int64_t i = 0; i < num_grasps; ++i) {
    const auto at = static_cast<size_t>(i);
    ForeignGrasp grasp;
    grasp.hand = "shadow";
    // The palm lies 34 mm along z in the root of its model: the root is the maker's wrist.
    grasp.root_link = "wrist";
    grasp.joint_names = joints;
    grasp.object = object;
    grasp.scale = scales[at];
    if (X_WOs.empty()) grasp.assumptions.push_back("the object's frame is the world: no obj_pose");
    if (object.empty()) grasp.assumptions.push_back("the file names no object");
    if (!labels.empty()) grasp.label = labels[at] != 0.0;
    const Pose X_OW =
        X_WOs.empty() ? Pose::Identity() : X_WOs[X_WOs.size() == 1 ? 0 : at].inverse();
    grasp.X_WO = SettlePose(X_OW.inverse());
    for (size_t s = 0; s < rows.size(); ++s) {
      const int64_t first = s == 0 && is_way ? 0 : i;
      const int64_t last = s == 0 && is_way ? rows[0].num_rows - 1 : i;
      for (int64_t row = first; row <= last; ++row) {
        const double* numbers = rows[s].row(row);
        const std::string where =
            fmt::format("{}, row {}", dict.WhereIs(std::string(kStages[s]) + "_qpos"), row);
        GraspStage stage;
        stage.name = kStages[s];
        stage.X_OR = SettlePose(X_OW * PoseFromNumbers(numbers, where));
        stage.joints.assign(numbers + kPoseSize, numbers + num_columns);
        grasp.stages.push_back(std::move(stage));
      }
    }
    grasps.push_back(std::move(grasp));
  }
  return grasps;
}

bool RecognisesDexgraspbench(std::string_view bytes) {
  return !bytes.empty() && (bytes.front() == '\x93' || bytes.front() == '\x80') &&
         bytes.find("grasp_qpos") != std::string_view::npos;
}

}  // namespace

GraspFormat MakeDexgraspbenchGraspFormat() {
  return {"dexgraspbench", "DexGraspBench, BODex, Dexonomy: .npy of the Shadow Hand",
          RecognisesDexgraspbench, ReadDexgraspbench};
}

}  // namespace graspbench
