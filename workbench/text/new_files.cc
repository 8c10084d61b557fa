#include "workbench/text/new_files.h"

#include <cmath>
#include <map>

#include "core/arm/load_arm.h"
#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "datasets/campaign/real_trials.h"
#include "datasets/judged_grasps/profile_file.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/session_config.h"
#include "human_study/study/design/study_config.h"
#include "objects/catalogue.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

std::string FormatComment(const FileKey& row) {
  const std::string range = FormatRange(row), unit = FindUnit(row.key);
  std::string about = range + (range.empty() || unit.empty() ? "" : " ") + unit;
  if (!about.empty()) about = "; " + about;
  return "# " + row.meaning + about;
}

// A complete configuration; what is empty by default stands as a comment.
std::string FormatConfig(const Json& config, const FileKeys& keys, const std::string& prefix,
                         const std::string& indent) {
  std::string text;
  for (const auto& [key, value] : config.items()) {
    if (value.is_object()) {
      text += (indent.empty() ? "\n" : "") + indent + key + ":\n" +
              FormatConfig(value, keys, prefix + key + ".", indent + "  ");
      continue;
    }
    const FileKey* row = FindFileKey(keys, prefix + key);
    if (row != nullptr) text += indent + FormatComment(*row) + "\n";
    const bool is_unset = (value.is_number() && std::isnan(value.get<double>())) ||
                          (value.is_string() && value == "") || (value.is_array() && value.empty());
    text += indent + (is_unset ? "# " + key + ":" : key + ": " + FormatJson(value)) + "\n";
  }
  return text;
}

std::string MakeSession() {
  return "# Simulated by `graspbench run session.yaml --out DIR`; every key is optional.\n" +
         FormatConfig(ConfigToJson(SessionConfig()), ListSessionKeys(), "", "");
}

std::string MakeSweepFile() {
  SweepConfig config;
  config.factors = {"model.mass_scale=1,0.5,2", "model.friction_scale=1,0.8"};
  config.trials = 4;
  return "# Simulated by `graspbench sweep sweep.yaml --out DIR`; every key except `factors` is "
         "optional.\n" +
         FormatConfig(ConfigToJson(config), ListSweepKeys(), "", "");
}

std::string MakeProfile() {
  return "# Protocol of `graspbench grasps judge --profile profile.yaml`; every key is "
         "optional.\n" +
         FormatConfig(ConfigToJson(FreeSpaceProfile()), ListProfileKeys(), "", "");
}

std::string MakeStudy() {
  StudyConfig config;
  config.name = "My study";
  config.factors = {"size_m"};
  config.markers.tips.thumb = {"thumb_tip"};
  config.markers.tips.index = {"index_tip"};
  config.analysis.contact.detector = "auto";
  // Stated ones would not follow the recordings' rate.
  AnalysisOptions& a = config.analysis;
  for (double* cutoff : {&a.movement.cutoff, &a.lift_off.cutoff, &a.hold.cutoff, &a.opening.cutoff,
                         &a.contact.cutoff, &a.contact.object_cutoff}) {
    *cutoff = std::nan("");
  }
  config.multiverse.cutoff.clear();
  return "# Analysed by `graspbench study run study.yaml --out DIR`; every key except `markers` is "
         "optional.\n# trials.csv names the recordings.\n" +
         FormatConfig(ConfigToJson(config), ListStudyKeys(), "", "");
}

std::string MakeObject() {
  const std::map<std::string, std::string> examples = {{"name", "my object"},
                                                       {"mesh", "mesh.obj"},
                                                       {"mesh_unit", "mm"},
                                                       {"mass_kg", "0.1"},
                                                       {"friction_static", "0.5"},
                                                       {"friction_dynamic", "0.4"},
                                                       {"grasp_order", "[g1, g3, g6, g2, g4]"}};
  std::string text = "# Properties of this object. Replace mesh.obj by your own mesh.\n";
  for (const FileKey& row : ListObjectKeys()) {
    if (const size_t dot = row.key.find('.'); dot != row.key.npos) {
      text += "#   " + row.key.substr(dot + 1) + ":  " + FormatComment(row) + "\n";
      continue;
    }
    const auto example = examples.find(row.key);
    text += FormatComment(row) + "\n" +
            (example == examples.end() ? "# " + row.key + ":" : row.key + ": " + example->second) +
            "\n";
  }
  return text;
}

constexpr int kPlannedTrials = 10;  ///< of each variant in a laboratory

/** A laboratory's trials of one scene: to be filled in, or with numbers that nobody has measured. */
std::string MakeRealTrials(int num_trials, bool is_made_up) {
  std::string text = "hand,object,variant,trial,success,t_TH_s,t_FF_s,t_MF_s,note\n";
  for (const VariantRow& variant : kVariants) {
    for (int trial = 0; trial < num_trials; ++trial) {
      text += std::string("tum,adhesive_tape,") + variant.name + "," + std::to_string(trial) + ",";
      if (!is_made_up) {
        text += ",,,,\n";
        continue;
      }
      const double spread = 0.12 - 0.04 * variant.value + 0.005 * (trial % 4);
      text += std::string(trial % 5 > variant.value ? "yes" : "no") + ",0.4," +
              FormatFixed(0.4 + spread, 3) + "," + FormatFixed(0.4 + 0.5 * spread, 3) +
              ",made up\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> ListNewKinds() {
  return {"session", "sweep", "object", "hand", "arm", "study", "trials", "profile"};
}

std::vector<NewFile> MakeNewFiles(const std::string& kind) {
  if (kind == "session") return {{"session.yaml", MakeSession()}};
  if (kind == "sweep") return {{"sweep.yaml", MakeSweepFile()}};
  if (kind == "profile") return {{"profile.yaml", MakeProfile()}};
  if (kind == "hand")
    return {{"hand.urdf", std::string(assets::kHandUrdf)},
            {"hand.yaml", std::string(assets::kHandYaml)}};
  if (kind == "arm") return {{"arm.yaml", std::string(assets::kArmYaml)}};
  if (kind == "study") {
    return {{"study.yaml", MakeStudy()},
            {"trials.csv", "participant,trial,file,size_m\nP01,1,P01_1.c3d,0.04\n"}};
  }
  if (kind == "trials") {
    return {{"trials.csv", MakeRealTrials(kPlannedTrials, false)},
            {"made-up-example.csv", MakeRealTrials(kPlannedTrials, true)}};
  }
  GRASPBENCH_DEMAND(kind == "object", kind);
  const TriMesh cube = MakeRoundedBox({0.04, 0.04, 0.04}, 0.0);
  return {{"object.yaml", MakeObject()}, {"mesh.obj", FormatObj(cube, 1e3)}};
}

void CheckNewFiles(const std::string& kind, const std::string& folder) {
  if (kind == "session") LoadSessionConfig(folder + "/session.yaml");
  if (kind == "sweep") MakeSweep(LoadSweepConfig(folder + "/sweep.yaml"));
  if (kind == "profile") LoadProfile(folder + "/profile.yaml");
  if (kind == "object") LoadObject(folder, FieldUse::kLater);
  if (kind == "hand") LoadStandardGrasps(LoadHand(folder));
  if (kind == "arm") LoadArm(folder);
  if (kind == "study") LoadStudy(folder + "/study.yaml");
  if (kind == "trials") {
    const std::string file = folder + "/made-up-example.csv";
    Diagnostics problems;
    ReadRealTrials(ReadFile(file), file, problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "the example cannot be read");
  }
}

}  // namespace graspbench
