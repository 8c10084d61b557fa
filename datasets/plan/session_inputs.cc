#include "datasets/plan/session_inputs.h"

#include <algorithm>
#include <regex>
#include <string_view>

#include "core/arm/arm_course.h"
#include "core/arm/load_arm.h"
#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "datasets/journal/store_kind.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "objects/object_file.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

constexpr char kInputs[] = "inputs";

bool IsOneOf(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** The folder that the name of an own hand or object stands for; its own name is the id. */
fs::path FindOriginal(const std::string& name) {
  fs::path path = fs::absolute(name).lexically_normal();
  if (path.filename() == "object.yaml" || !path.has_filename()) path = path.parent_path();
  return path;
}

/** Of an own hand or object, within the folder of copies. */
fs::path FindPlace(const char* kind, const std::string& name) {
  return fs::path(kind) / FindOriginal(name).filename();
}

/** The session that an experiment's folder belongs to; else the folder itself. */
fs::path FindOwner(const fs::path& folder) {
  if (folder.empty()) return folder;
  const fs::path place = fs::absolute(folder).lexically_normal();
  const fs::path above = place.parent_path().parent_path();
  const bool is_part = FindStoreKind(above) == &kSessionStore &&
                       IsMatch(place.lexically_relative(above).string(), kSessionStore.stores);
  return is_part ? above : folder;
}

/** A copy of the store itself, of the session or of the campaign that it is part of; empty: none.
@param place  within the folder of copies. */
fs::path FindInput(const fs::path& part, const fs::path& place) {
  if (part.empty()) return {};
  std::error_code status;
  const auto find = [&](const fs::path& store) {
    const fs::path copy = store / kInputs / place;
    return fs::exists(copy, status) ? copy : fs::path();
  };
  if (const fs::path own = find(part); !own.empty()) return own;
  const fs::path folder = FindOwner(part);
  if (const fs::path own = find(folder); !own.empty()) return own;
  for (const fs::path& above : {folder / "..", folder / ".." / ".."}) {
    if (FindStoreKind(above) == &kCampaignStore) return find(above);
  }
  return {};
}

/** The copy, or the name when there is none. */
std::string ChooseInput(const std::string& name, const fs::path& folder, const fs::path& place) {
  const fs::path copy = FindInput(folder, place);
  return copy.empty() ? name : copy.string();
}

void CopyFiles(const fs::path& from, const fs::path& to, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const fs::path name = fs::path(file).lexically_normal();
    if (name.is_absolute() || *name.begin() == "..") {
      throw Error(ErrorKind::kUsage, "\"" + from.string() + "\" names \"" + file +
                                         "\", which lies outside that folder, so that a session "
                                         "cannot keep a copy; move it inside");
    }
    MakeFolder((to / name).parent_path());
    WriteFile(to / name, ReadFile(from / name));
  }
}

/** Texts that `pattern` finds in the file, each once. */
std::vector<std::string> ListNamed(const fs::path& path, const std::regex& pattern) {
  const std::string text = ReadFile(path);
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    if (!IsOneOf((*match)[1], names)) names.push_back((*match)[1]);
  }
  return names;
}

/** Of the meshes that a hand.urdf names. */
const std::regex& MeshPattern() {
  static const std::regex pattern("filename\\s*=\\s*[\"']([^\"']+)[\"']");
  return pattern;
}

void CopyHand(const fs::path& from, const fs::path& to) {
  std::vector<std::string> files = {"hand.urdf", "hand.yaml"};
  if (fs::is_regular_file(from / "tactile.yaml")) files.push_back("tactile.yaml");
  for (const std::string& mesh : ListNamed(from / "hand.urdf", MeshPattern())) {
    // A name in a comment may stand for nothing.
    if (fs::is_regular_file(from / mesh)) files.push_back(mesh);
  }
  CopyFiles(from, to, files);
}

void CopyObject(const fs::path& from, const fs::path& to) {
  std::vector<std::string> files = {"object.yaml", LoadObjectFile(from / "object.yaml").mesh};
  if (fs::path(files[1]).extension() == ".gltf") {
    const Json gltf = Json::try_parse(ReadFile(from / files[1]));
    for (const Json& buffer : gltf.value("buffers", Json::array())) {
      const std::string uri = buffer.value("uri", "");
      if (!uri.empty() && uri.rfind("data:", 0) != 0) files.push_back(uri);
    }
  }
  CopyFiles(from, to, files);
}

const std::vector<std::string> kAll = {"all"};

/** @returns the grasp's id. */
std::string AddGraspFile(const std::string& path, SessionInputs& inputs) {
  std::vector<const Hand*> hands;
  for (const SessionHand& hand : inputs.hands) hands.push_back(hand.hand.get());
  const GraspFile file = LoadGraspFile(path, hands);
  for (SessionHand& hand : inputs.hands) {
    if (hand.hand->id == file.hand) hand.grasps.push_back(file.grasp);
  }
  return file.grasp.id;
}

void AddGrasp(const std::string& text, const std::string& file, SessionInputs& inputs) {
  std::vector<const Hand*> hands;
  for (const SessionHand& hand : inputs.hands) hands.push_back(hand.hand.get());
  const GraspFile made = ParseGraspFile(text, file, hands);
  for (SessionHand& hand : inputs.hands) {
    if (hand.hand->id == made.hand) hand.grasps.push_back(made.grasp);
  }
}

/** Those of the folder, of an earlier run, or made now. What is kept is rounded, so all are read
from their text.
@param suffix  of the folders of a condition that chooses again. */
void AddRehearsed(const SessionConfig& config, const fs::path& folder, const std::string& suffix,
                  SessionInputs& inputs) {
  for (const RehearsalConfig& rehearsal : ListRehearsals(config)) {
    CheckSessionConfig(config);  // before anything is simulated
    const std::string id = NameRehearsed(rehearsal);
    for (size_t h = 0; h < inputs.hands.size(); ++h) {
      const std::shared_ptr<const Hand> hand = inputs.hands[h].hand;
      const std::vector<Grasp> grasps = inputs.hands[h].grasps;
      for (const auto& object : inputs.objects) {
        const std::string place =
            "grasps/" + id + suffix + "/" + hand->id + "/" + object->id + ".yaml";
        const fs::path copy = FindInput(folder, place);
        std::string& text = inputs.rehearsed[place];
        if (!copy.empty()) {
          text = ReadFile(copy);
        } else {
          RehearsalTask task = MakeRehearsalTask(config, rehearsal, hand, grasps, object);
          task.arm = inputs.hands[h].arm;
          const RehearsedCandidate choice = FindRehearsal(task).choice();
          text = FormatRehearsedGrasp(task, choice.candidate, id);
          const std::string doubt =
              DescribeDoubt(hand->id, object->id, Describe(choice.candidate), choice.CountHeld(),
                            static_cast<int>(choice.outcomes.size()));
          if (!doubt.empty()) inputs.doubts.push_back(doubt);
        }
        AddGrasp(text, place, inputs);
      }
    }
  }
}

/** The types of best grasps: those of the folder, stored ones, or made now. */
void AddTypes(const SessionConfig& config, const fs::path& folder, const std::string& suffix,
              SessionInputs& inputs) {
  if (!HasBestGrasp(config)) return;
  const std::string place = "grasps/" + (kBestGrasp + suffix) + "/types.json";
  const fs::path copy = FindInput(folder, place);
  if (!copy.empty()) inputs.types = ParseTypes(ReadFile(copy), copy.string());
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      if (inputs.types.count({hand.hand->id, object->id}) > 0) continue;
      const RehearsalTask all = MakeRehearsalTask(config, {}, hand.hand, hand.grasps, object);
      if (!NeedsType(all)) continue;
      auto type = suffix.empty() ? FindShippedType(all) : std::nullopt;
      if (!type) {
        CheckSessionConfig(config);  // before anything is simulated
        const RehearsalTask task = MakeTypeTask(all, kTypeDraws);
        type = MakeType(task, FindRehearsal(task));
      }
      inputs.types.emplace(std::pair(hand.hand->id, object->id), *type);
    }
  }
  inputs.rehearsed[place] = FormatTypes(inputs.types);
}

/** To a condition's hands, where nothing is rehearsed again. */
void TakeRehearsed(const SessionInputs& base, SessionInputs& inputs) {
  for (const auto& [place, text] : base.rehearsed) {
    if (IsGraspFile(place)) AddGrasp(text, place, inputs);
  }
}

/** The session's word comes before the objects' and the grasps'; automatic: it says none. */
Approach FindApproach(const SessionConfig& config) {
  const ApproachRow* row = FindRow(kApproaches, config.approach);
  return row ? row->value : Approach::kAutomatic;  // an unknown one is refused with the rest
}

void ApplyApproach(Approach approach, std::vector<SessionHand>& hands) {
  if (approach == Approach::kAutomatic) return;
  for (SessionHand& hand : hands) {
    for (Grasp& grasp : hand.grasps) {
      if (!grasp.placement) grasp.approach = approach;
    }
  }
}

/** All that decides what hands and objects are. */
Json DescribeInputs(const SessionConfig& config) {
  return Json{ConfigToJson(config.model), ConfigToJson(config.imperfections), config.approach,
              ConfigToJson(config.arm)};
}

/** All that decides what is rehearsed. */
Json DescribeRehearsals(const SessionConfig& config) {
  Json decides = {ConfigToJson<TrialConditions>(config), ConfigToJson(config.imperfections),
                  config.approach};
  if (HasArm(config.arm)) decides.push_back(ConfigToJson(config.arm));
  return decides;
}

/** What touches in the ready posture touches in every trial, and comes of wrong rows. */
void DemandFreeReady(const MountedArm& mounted, const Hand& hand) {
  const std::string touched = FindReadyCollision(mounted, hand);
  if (touched.empty()) return;
  throw Error(ErrorKind::kRange,
              "the arm \"" + mounted.arm->id + "\": in its ready posture " + touched +
                  "; check ready_deg, the signs of alpha_deg, a_m and d_m, and the capsules");
}

/** Hands and objects that were read or made already: thousands of conditions share them. */
class KnownInputs {
 public:
  KnownInputs(FieldUse field_use, fs::path folder)
      : field_use_(field_use), folder_(std::move(folder)) {}

  /** With model, imperfections and arm of the session, and its standard grasps. */
  const SessionHand& FindHand(const std::string& name, const SessionConfig& config) {
    ModelConfig model = config.model;
    model.mass_scale = 1.0;  // of objects
    SessionHand& made = hands_[FormatJson(
        {name, ConfigToJson(model), ConfigToJson(config.imperfections), ConfigToJson(config.arm)})];
    if (made.hand) return made;
    auto& read = read_hands_[name];
    if (!read) read = std::make_shared<Hand>(LoadHand(FindHandInput(name, folder_)));
    auto hand = std::make_shared<Hand>(*read);
    ApplyModel(model, *hand);
    ApplyImperfections(config.imperfections, *hand);
    std::vector<Grasp> grasps = LoadStandardGrasps(*hand);
    std::shared_ptr<const MountedArm> mounted;
    if (HasArm(config.arm)) {
      auto& arm = arms_[config.arm.model];
      if (!arm) arm = std::make_shared<Arm>(LoadArm(FindArmInput(config.arm.model, folder_)));
      DemandShortChains(*hand, arm->num_joints());
      mounted = std::make_shared<MountedArm>(MountArm(config.arm, arm, *hand));
      DemandFreeReady(*mounted, *hand);
    }
    made = {std::move(hand), std::move(grasps), std::move(mounted)};
    return made;
  }

  /** With model and approach of the session. */
  std::shared_ptr<const GraspObject> FindObject(const std::string& name,
                                                const SessionConfig& config) {
    ModelConfig model = config.model;
    const ModelConfig plain;  // of hands:
    model.drive_torque_scale = plain.drive_torque_scale;
    model.joint_error_scale = plain.joint_error_scale;
    model.coupling_rule = plain.coupling_rule;
    auto& made = objects_[FormatJson({name, ConfigToJson(model), config.approach})];
    if (made) return made;
    auto& read = read_objects_[name];
    if (!read) read = LoadObject(FindObjectInput(name, folder_), field_use_);
    auto object = std::make_shared<GraspObject>(*read);
    ApplyModel(model, *object);
    const Approach approach = FindApproach(config);
    if (approach != Approach::kAutomatic) object->approach = approach;
    made = std::move(object);
    return made;
  }

 private:
  FieldUse field_use_;
  fs::path folder_;
  std::map<std::string, std::shared_ptr<const Arm>> arms_;
  std::map<std::string, std::shared_ptr<const Hand>> read_hands_;
  std::map<std::string, std::shared_ptr<const GraspObject>> read_objects_, objects_;
  std::map<std::string, SessionHand> hands_;
};

SessionInputs LoadBaseInputs(const SessionConfig& config, const std::filesystem::path& folder,
                             KnownInputs& known) {
  SessionInputs inputs;
  for (const std::string& name : config.hands == kAll ? ListHands() : config.hands) {
    inputs.hands.push_back(known.FindHand(name, config));
  }
  for (const std::string& name : config.objects == kAll ? ListObjects() : config.objects) {
    inputs.objects.push_back(known.FindObject(name, config));
  }
  for (size_t i = 0; i < config.grasps.size(); ++i) {
    const std::string& name = config.grasps[i];
    if (IsGraspFile(name)) {
      inputs.grasp_files[name] = AddGraspFile(FindGraspInput(name, i, folder), inputs);
    }
    for (const std::string& path : ListSceneGrasps(name, folder)) AddGraspFile(path, inputs);
  }
  ApplyApproach(FindApproach(config), inputs.hands);
  return inputs;
}

}  // namespace

void GatherHand(const fs::path& from, const fs::path& to) {
  std::string urdf = ReadFile(from / "hand.urdf");
  const std::vector<std::string> meshes = ListNamed(from / "hand.urdf", MeshPattern());
  std::vector<std::string> files = {"hand.yaml"}, taken = meshes;
  if (fs::is_regular_file(from / "tactile.yaml")) files.push_back("tactile.yaml");
  for (const std::string& mesh : meshes) {
    if (!fs::is_regular_file(from / mesh)) continue;
    const fs::path name = fs::path(mesh).lexically_normal();
    if (!name.is_absolute() && *name.begin() != "..") {
      files.push_back(mesh);
      continue;
    }
    std::string own = "meshes/" + name.filename().string();
    while (IsOneOf(own, taken)) own.insert(own.find('/') + 1, "other_");
    taken.push_back(own);
    MakeFolder(to / "meshes");
    WriteFile(to / own, ReadFile(from / mesh));
    for (size_t at = 0; (at = urdf.find(mesh, at)) != std::string::npos; at += own.size()) {
      urdf.replace(at, mesh.size(), own);
    }
  }
  MakeFolder(to);
  WriteFile(to / "hand.urdf", urdf);
  CopyFiles(from, to, files);
}

bool IsGraspFile(const std::string& name) {
  constexpr std::string_view kEnding = ".yaml";
  return name.size() > kEnding.size() &&
         name.compare(name.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

void CopyInputs(const SessionConfig& config, const fs::path& folder) {
  const fs::path inputs = folder / kInputs;
  std::vector<std::string> own = ListHands();
  own.push_back("all");
  for (const std::string& name : config.hands) {
    if (!IsOneOf(name, own)) CopyHand(FindOriginal(name), inputs / FindPlace("hands", name));
  }
  for (const std::string& name : config.objects) {
    if (name == "all" || ComesWithProgram(name)) continue;
    CopyObject(FindOriginal(name), inputs / FindPlace("objects", name));
  }
  own = ListArms();
  own.push_back(ArmConfig::kNone);
  if (!IsOneOf(config.arm.model, own)) {
    CopyFiles(FindOriginal(config.arm.model), inputs / FindPlace("arms", config.arm.model),
              {"arm.yaml"});
  }
  for (size_t i = 0; i < config.grasps.size(); ++i) {
    if (!IsGraspFile(config.grasps[i])) continue;
    MakeFolder(inputs / "grasps");
    WriteFile(inputs / "grasps" / (std::to_string(i) + ".yaml"), ReadFile(config.grasps[i]));
  }
  if (fs::exists(inputs)) SyncFileSystem(folder);  // once for thousands of files
}

void CopyRehearsed(const SessionInputs& inputs, const fs::path& folder) {
  for (const auto& [place, text] : inputs.rehearsed) {
    MakeFolder((folder / kInputs / place).parent_path());
    WriteFileAtomically(folder / kInputs / place, text);
  }
}

std::string FindHandInput(const std::string& name, const fs::path& folder) {
  return ChooseInput(name, folder, FindPlace("hands", name));
}

std::string FindObjectInput(const std::string& name, const fs::path& folder) {
  return ChooseInput(name, folder, FindPlace("objects", name));
}

std::string FindArmInput(const std::string& name, const fs::path& folder) {
  return ChooseInput(name, folder, FindPlace("arms", name));
}

std::string FindGraspInput(const std::string& name, size_t number, const fs::path& folder) {
  return ChooseInput(name, folder, fs::path("grasps") / (std::to_string(number) + ".yaml"));
}

std::vector<std::string> ListSceneGrasps(const std::string& id, const fs::path& folder) {
  const fs::path campaign = FindOwner(folder) / "..";
  std::vector<std::string> files;
  if (folder.empty() || FindStoreKind(campaign) != &kCampaignStore) return files;
  for (const std::string& name : ListMatches(campaign, {"scenes/*/" + id + ".yaml"})) {
    files.push_back((campaign / name).string());
  }
  return files;
}

SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use,
                                const std::filesystem::path& folder) {
  KnownInputs parts(field_use, folder);
  SessionInputs inputs = LoadBaseInputs(config, folder, parts);
  AddRehearsed(config, folder, "", inputs);
  AddTypes(config, folder, "", inputs);
  const std::shared_ptr<const SessionInputs> base = std::make_shared<SessionInputs>(inputs);
  std::map<std::string, std::shared_ptr<const SessionInputs>> known = {
      {FormatJson(DescribeInputs(config)), base}};
  SessionConfig plain = config;  // so that not each condition copies all
  plain.conditions.clear();
  for (const Condition& condition : config.conditions) {
    ConditionInputs made = ApplyCondition(condition, plain);
    const std::string decides = FormatJson(DescribeRehearsals(made.config));
    const bool chooses_again =
        ChoosesGraspAgain(condition) && decides != FormatJson(DescribeRehearsals(config));
    std::shared_ptr<const SessionInputs>& shared =
        known[chooses_again ? decides : FormatJson(DescribeInputs(made.config))];
    if (!shared) {
      SessionInputs changed = LoadBaseInputs(made.config, folder, parts);
      if (chooses_again) {
        const std::string suffix = "-" + CalcHashHex(decides).substr(0, 8);
        AddRehearsed(made.config, folder, suffix, changed);
        AddTypes(made.config, folder, suffix, changed);
        inputs.rehearsed.insert(changed.rehearsed.begin(), changed.rehearsed.end());
      } else {
        TakeRehearsed(*base, changed);
        changed.base = base;
      }
      shared = std::make_shared<SessionInputs>(std::move(changed));
    }
    made.inputs = shared;
    inputs.conditions.emplace(condition.name, std::move(made));
  }
  return inputs;
}

}  // namespace graspbench
