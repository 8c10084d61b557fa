#include "workbench/experiments/grasp_inputs.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/free_space_profile.h"
#include "datasets/grasps/map_to_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kOpenHandAlone[] =
    "the file states only the open hand; it needs a profile that closes the hand (closing.to: "
    "limits, as in multigripper)";
constexpr double kJitterShift = 0.001;           // [m]
constexpr double kJitterTurn = RadFromDeg(1.0);  // [rad]

bool IsFile(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

fs::path FindMeshAt(const fs::path& folder, const fs::path& end) {
  std::vector<fs::path> candidates = {end};
  for (const char* ending : {".obj", ".stl", ".ply", ".glb", ".gltf"}) {
    candidates.push_back(end.string() + ending);
  }
  for (const char* inside :
       {"mesh/simplified.obj", "simplified.obj", "mesh.obj", "coacd/decomposed.obj"}) {
    candidates.push_back(end / inside);
  }
  std::vector<fs::path> found;
  for (const fs::path& candidate : candidates) {
    if (IsFile(folder / candidate)) found.push_back(candidate);
  }
  if (found.size() > 1) {
    throw Error(ErrorKind::kFormat, "both " + found[0].generic_string() + " and " +
                                        found[1].generic_string() +
                                        " match its name; keep one of them");
  }
  return found.empty() ? fs::path() : folder / found.front();
}

/** Joints of the wrist that no stage moves are not the file's. */
std::vector<bool> FindAsked(const Hand& hand, const std::vector<GraspInput>& grasps) {
  std::vector<bool> is_asked(hand.joints.size(), true);
  for (int link = hand.palm_link; link >= 0; link = hand.links[static_cast<size_t>(link)].parent) {
    const int joint = hand.links[static_cast<size_t>(link)].joint;
    if (joint < 0) continue;
    is_asked[static_cast<size_t>(joint)] =
        std::any_of(grasps.begin(), grasps.end(), [&](const GraspInput& input) {
          return std::any_of(input.stages.begin(), input.stages.end(),
                             [&](const ScriptedStage& stage) { return stage.q[joint] != 0.0; });
        });
  }
  return is_asked;
}

class ObjectLoader {
 public:
  explicit ObjectLoader(fs::path folder) : folder_(std::move(folder)) {}

  /** @throws Error(kNotFound) when there is no such mesh, kFormat, kRange when it is of no use. */
  std::shared_ptr<const GraspObject> Load(const std::string& name, double scale) {
    const auto key = std::make_pair(name, scale);
    if (const auto found = refused_.find(key); found != refused_.end()) throw Error(found->second);
    if (const auto found = loaded_.find(key); found != loaded_.end()) return found->second;
    try {
      return loaded_[key] = Find(name, scale);
    } catch (const Error& error) {
      loaded_.erase(key);
      if (ExitCodeOf(error.kind()) == kExitEnvironment) throw;  // of the machine, not of the mesh
      refused_.emplace(key, error);
      throw;
    }
  }

  Json Describe() const {
    Json objects = Json::array();
    for (const auto& [key, object] : loaded_) {
      objects.push_back(
          {{"name", key.first}, {"scale", key.second}, {"content", object->content_hash}});
    }
    return objects;
  }

 private:
  fs::path folder_;
  std::map<std::pair<std::string, double>, std::shared_ptr<const GraspObject>> loaded_;
  std::map<std::pair<std::string, double>, Error> refused_;

  /** What is wrong with it is said without the machine's path. */
  std::shared_ptr<const GraspObject> LoadMesh(const fs::path& mesh, double scale) const {
    try {
      return LoadMeshObject(mesh, scale);
    } catch (const Error& error) {
      const std::string inside = mesh.lexically_relative(folder_).generic_string();
      throw Error(error.kind(), NameInside(error.what(), mesh, inside));
    }
  }

  std::shared_ptr<const GraspObject> Find(const std::string& name, double scale) const {
    const fs::path mesh = FindObjectMesh(folder_, name);
    if (!mesh.empty()) return LoadMesh(mesh, scale);
    const std::vector<std::string> ids = ListObjects();
    if (scale == 1.0 && std::find(ids.begin(), ids.end(), name) != ids.end()) {
      return LoadObject(name);
    }
    throw Error(ErrorKind::kNotFound, "no mesh for \"" + name +
                                          "\" in the folder of --objects, which is searched for "
                                          "the whole path and for every end of it");
  }
};

/** Of all that a verdict depends on. */
std::string HashGrasp(const GraspInput& input) {
  const auto list = [](const auto& matrix) {
    return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
  };
  Json json = {input.grasp.object, input.grasp.scale, list(input.grasp.X_WO.matrix()),
               input.grasp.label ? Json(*input.grasp.label) : Json()};
  for (const ScriptedStage& stage : input.stages) {
    json.push_back({stage.name, list(stage.X_OH.matrix()), list(stage.q)});
  }
  if (input.table) {
    json.push_back({list(input.table->shares), list(input.table->down_H), input.table->counts,
                    input.table->num_touching});
  }
  return CalcHashHex(FormatJson(json));
}

Eigen::Vector3d DrawDirection(RandomStream& random) {
  const Eigen::Vector3d v(random.NextNormal(), random.NextNormal(), random.NextNormal());
  return v.norm() > 1e-9 ? Eigen::Vector3d(v.normalized()) : Eigen::Vector3d::UnitX();
}

/** X_HH': where H is instead. */
Pose DrawDisturbance(const ForeignGrasp& grasp, int jitter) {
  RandomStream random(FormatJson({grasp.source, grasp.index, jitter}), "disturbance of a grasp");
  const Eigen::Vector3d shift = kJitterShift * DrawDirection(random);
  return MakePose(Eigen::AngleAxisd(kJitterTurn, DrawDirection(random)).toRotationMatrix(), shift);
}

}  // namespace

fs::path FindObjectMesh(const fs::path& folder, const std::string& name) {
  if (name.empty()) return {};
  std::vector<fs::path> parts;
  for (const fs::path& part : fs::path(name).lexically_normal()) {
    if (part != "/" && part != ".." && !part.empty()) parts.push_back(part);
  }
  for (size_t first = 0; first < parts.size(); ++first) {
    fs::path end;
    for (size_t i = first; i < parts.size(); ++i) end /= parts[i];
    if (const fs::path mesh = FindMeshAt(folder, end); !mesh.empty()) return mesh;
  }
  return {};
}

GraspInputs LoadGraspInputs(GraspCollection collection, const std::string& hand,
                            const fs::path& folder, const std::vector<FreeSpaceProfile>& profiles) {
  std::set<size_t> without_closing;
  for (size_t p = 0; p < profiles.size(); ++p) {
    const std::string& to = profiles[p].closing.to;
    if (RowFromName(kClosingRules, to, "rule for closing").value != ClosingRule::kLimits)
      without_closing.insert(p);
  }
  GraspInputs inputs;
  inputs.hand = std::make_shared<const Hand>(LoadHand(hand));
  DemandShortChains(*inputs.hand);
  inputs.unread = std::move(collection.unread);
  ObjectLoader objects(folder);
  std::set<std::pair<std::string, int>> names;
  for (ForeignGrasp& grasp : collection.grasps) {
    if (!names.emplace(grasp.source, grasp.index).second) {
      throw Error(ErrorKind::kUsage, "two grasps are named \"" + NameGrasp(grasp) +
                                         "\"; give every file once; for files of equal name give "
                                         "the folder above their folders");
    }
    GraspInput input;
    try {
      if (grasp.stages.size() == 1 && grasp.stages.front().name == "pregrasp")
        input.unfit = without_closing;
      if (!profiles.empty() && input.unfit.size() == profiles.size())
        throw Error(ErrorKind::kFormat, kOpenHandAlone);
      const HandGrasp mapped = MapToHand(grasp, *inputs.hand);
      input.table = mapped.table;
      for (const HandStage& stage : mapped.stages) {
        input.stages.push_back({stage.name, stage.X_OH, stage.q});
      }
      input.object = objects.Load(grasp.object, grasp.scale);
    } catch (const Error& error) {
      if (ExitCodeOf(error.kind()) == kExitEnvironment) throw;
      inputs.unread.push_back({NameGrasp(grasp), error.what()});
      continue;
    }
    input.grasp = std::move(grasp);
    inputs.grasps.push_back(std::move(input));
  }
  if (inputs.grasps.empty()) {
    std::string reasons;
    for (const UnreadFile& file : inputs.unread) {
      if (reasons.size() < 2000) reasons += "\n  " + file.name + ": " + file.reason;
    }
    throw Error(ErrorKind::kFormat, "no grasp can be judged:" + reasons);
  }
  for (size_t p = 0; p < profiles.size(); ++p) {
    const auto num_unfit =
        std::count_if(inputs.grasps.begin(), inputs.grasps.end(),
                      [&](const GraspInput& input) { return input.unfit.count(p) > 0; });
    if (num_unfit == 0) continue;
    inputs.unread.push_back({"profile " + profiles[p].name,
                             "does not fit " + std::to_string(num_unfit) + " of " +
                                 FormatCount(static_cast<int64_t>(inputs.grasps.size()), "grasp") +
                                 ": " + kOpenHandAlone});
  }
  inputs.is_asked = FindAsked(*inputs.hand, inputs.grasps);
  Json grasps = Json::array();
  for (const GraspInput& input : inputs.grasps) {
    grasps.push_back({input.grasp.source, input.grasp.index, HashGrasp(input)});
  }
  inputs.description = {{"hand", inputs.hand->id},
                        {"hand_content", inputs.hand->content_hash},
                        {"objects", objects.Describe()},
                        {"grasps", grasps}};
  return inputs;
}

std::string NameGrasp(const ForeignGrasp& grasp) {
  return grasp.source + ", grasp " + std::to_string(grasp.index);
}

const GraspInput& FindGraspInput(const GraspInputs& inputs, int number) {
  if (number >= 0 && number < static_cast<int>(inputs.grasps.size())) {
    const GraspInput& input = inputs.grasps[static_cast<size_t>(number)];
    if (input.unfit.empty()) return input;
    throw Error(ErrorKind::kFormat, NameGrasp(input.grasp) + ": " + kOpenHandAlone);
  }
  throw Error(ErrorKind::kUsage, "--grasp " + std::to_string(number) + ": there are " +
                                     FormatCount(static_cast<int>(inputs.grasps.size()), "grasp") +
                                     " that can be judged, counted from 0");
}

ProfiledScene MakeInputScene(const GraspInputs& inputs, const GraspInput& input,
                             const FreeSpaceProfile& profile, int jitter) {
  std::vector<ScriptedStage> stages = input.stages;
  if (jitter > 0) {
    const Pose X_HD = DrawDisturbance(input.grasp, jitter);
    for (ScriptedStage& stage : stages) stage.X_OH = stage.X_OH * X_HD;
  }
  ProfiledScene scene = MakeProfiledScene(MakeProfiledHand(*inputs.hand, profile, inputs.is_asked),
                                          MakeProfiledObject(*input.object, profile),
                                          input.grasp.X_WO, std::move(stages), profile);
  scene.table = input.table;
  return scene;
}

FreeSpaceResult JudgeGraspInput(const GraspInputs& inputs, const GraspInput& input,
                                const FreeSpaceProfile& profile, int jitter) {
  return RunFreeSpace(MakeInputScene(inputs, input, profile, jitter), profile);
}

}  // namespace graspbench
