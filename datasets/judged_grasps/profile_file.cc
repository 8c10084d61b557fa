#include "datasets/judged_grasps/profile_file.h"

#include <algorithm>
#include <filesystem>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "datasets/plan/session_keys.h"
#include "datasets/plan/sim_check.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

using Problems = std::vector<std::pair<std::string, std::string>>;

template <class Row, size_t N>
void CheckWord(const Row (&table)[N], const char* key, const std::string& word,
               Problems& problems) {
  if (FindRow(table, word)) return;
  std::string known;
  for (const std::string& name : ListNames(table)) known += (known.empty() ? "" : ", ") + name;
  problems.emplace_back(key, "\"" + word + "\" is unknown; expected " + known);
}

/** The key, and what is wrong with its value. */
Problems FindProblems(const FreeSpaceProfile& profile) {
  Problems problems = FindOutOfRange(profile, ListProfileKeys());
  CheckWord(kOwnOrGiven, "drives.law", profile.drives.law, problems);
  CheckWord(kBeyondLimits, "drives.beyond_limits", profile.drives.beyond_limits, problems);
  CheckWord(kOwnOrGiven, "surfaces.pads", profile.surfaces.pads, problems);
  CheckWord(kStageChoices, "closing.stages", profile.closing.stages, problems);
  CheckWord(kClosingRules, "closing.to", profile.closing.to, problems);
  CheckWord(kProfileTests, "test", profile.test, problems);
  for (const auto& problem : FindSimProblems(profile.sim)) problems.push_back(problem);
  const bool is_lift = profile.test == "lift";
  if (is_lift && profile.lift_height <= profile.max_shift) {
    problems.emplace_back("lift_height_m",
                          "must be above max_shift_m: an object that is left behind would pass");
  }
  if (profile.finds_breaking_load && (profile.test != "pushes" || profile.acceleration <= 0.0)) {
    problems.emplace_back("finds_breaking_load", "needs pushes with an acceleration above 0");
  }
  if (profile.sim.gravity != 0.0) {
    problems.emplace_back("sim.gravity_m_per_s2",
                          "expected 0: acceleration_m_per_s2 says what acts on the object");
  }
  return problems;
}

fs::path FindProfileFolder() { return FindDataRoot() / "datasets" / "profiles"; }

}  // namespace

const FileKeys& ListProfileKeys() {
  static const FileKeys keys = [] {
    FileKeys rows = {
        {"about", "", "one line for lists"},
        {"source", "", "where the values come from"},
        {"drives.law", "", "own: the hand's drives; given: these four, of every joint that turns"},
        {"drives.stiffness_nm_per_rad", "", "of a given drive", 0, 1e4},
        {"drives.damping_nms_per_rad", "", "of a given drive, with that of its joint", 0, 1e3},
        {"drives.friction_nm", "", "of a given drive, sticking and sliding", 0, 10},
        {"drives.armature_kg_m2", "", "of a given drive: its rotor, as the joint feels it", 0, 1},
        {"drives.torque_limit_nm", "", "of a given drive; 0: the hand's own", 0, 1e3},
        {"drives.free_distal", "",
         "joints that a finger's middle joint moves along have a drive of their own"},
        {"drives.beyond_limits", "",
         "a stage asks for more than a joint's limits: refuse the grasp, clip the command, or "
         "ignore "
         "it (the stop pushes back)"},
        {"surfaces.pads", "", "own: the hand's soft pads; given: bare links with this torsion"},
        {"surfaces.torsion_radius_m", "",
         "resists spin up to friction times normal force times this; of given pads", 0, 0.1},
        {"surfaces.relaxation_time_s", "", "damping of a contact over its stiffness; of given pads",
         0.001, 1},
        {"surfaces.friction", "", "of hand and object, and of the hand with itself", 0, 5},
        {"closing.stages", "",
         "those of the grasp that the hand goes through: all; first, to close from the open hand; "
         "grasp, to begin at it"},
        {"closing.to", "",
         "what the joints are asked for after the last stage: stated, as it says; press, beyond it "
         "where a link touches; limits, closed as far as they go"},
        {"closing.press_rad_per_m", "",
         "of press: so much of each joint by how far it moves a touching point into the object", 0,
         100},
        {"closing.press_reach_m", "",
         "of press: the points that touch are nearer to the surface than this", 0, 0.05},
        {"closing.object_is_held", "",
         "until two of digits and palm touch it, the object is put back after each step; where "
         "that never comes, the grasp fails"},
        {"object_mass_kg", "", "0: by the density", 0, 100},
        {"object_density_kg_per_m3", "", "of the mesh's volume, where the mass is 0", kAboveZero,
         3e4},
        {"stage_time_s", "", "from one stage of the grasp to the next", 0.001, 60},
        {"stage_updates", "", "the commands change so often in a stage; 0: in every step", 0,
         10000},
        {"test", "",
         "pushes: six, along the axes of the file's world; fall: one, out of the palm along its "
         "normal; lift: from a table at the world's z = 0"},
        {"acceleration_m_per_s2", "",
         "times the object's mass: the push, or the weight of a lift from the start", 0, 1000},
        {"test_time_s", "", "of each push, or of the lift", 0.01, 60},
        {"check_interval_s", "", "between looks at how far the object has moved", 0.001, 60},
        {"lift_height_m", "", "of a lift", 0, 1},
        {"max_start_penetration_m", "", "of hand and object at the first stage", 0, 0.1},
        {"max_shift_m", "", "of the object from where it began", kAboveZero, 10},
        {"max_turn_deg", "", "of the object from how it began", kAboveZero, 360},
        {"must_touch", "", "in the last look the hand touches the object"},
        {"finds_breaking_load", "",
         "of pushes: also the largest that the grasp stands along all six axes, to 5 %"}};
    for (const FileKey& row : ListSessionKeys()) {
      if (row.key == "sim.gravity_m_per_s2") {
        rows.push_back(
            {row.key, "", "0: acceleration_m_per_s2 says what acts on the object", 0, 0});
      } else if (row.key.rfind("sim.", 0) == 0) {
        rows.push_back(row);
      }
    }
    return DescribeConfig(FreeSpaceProfile(), rows);
  }();
  return keys;
}

FreeSpaceProfile ParseProfile(const std::string& text, const std::string& file) {
  FreeSpaceProfile profile;
  profile.name = fs::path(file).stem().string();
  Diagnostics problems;
  const YAML::Node root = ParseYaml(text, file, problems);
  if (!root.IsMap()) {
    throw Error(ErrorKind::kFormat, file +
                                        ": no profile: expected keys and their values; graspbench "
                                        "new profile NAME makes a file with all of them");
  }
  ReadConfig(root, file, "profile", profile, problems);
  if (problems.num_errors() == 0) {
    for (const auto& [key, fault] : FindProblems(profile)) {
      problems.Fail(file, FindConfigLine(root, key), key + ": " + fault);
    }
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the profile cannot be used");
  return profile;
}

std::vector<FreeSpaceProfile> ListProfiles() {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(FindProfileFolder(), none)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<FreeSpaceProfile> profiles;
  for (const fs::path& file : files) {
    profiles.push_back(ParseProfile(ReadFile(file), file.string()));
  }
  return profiles;
}

FreeSpaceProfile LoadProfile(const std::string& name_or_path) {
  const std::vector<FreeSpaceProfile> known = ListProfiles();
  std::vector<std::string> names;
  for (const FreeSpaceProfile& profile : known) {
    if (profile.name == name_or_path) return profile;
    names.push_back(profile.name);
  }
  if (fs::exists(name_or_path)) {
    FreeSpaceProfile profile = ParseProfile(ReadFile(name_or_path), name_or_path);
    for (const FreeSpaceProfile& shipped : known) {
      if (shipped.name != profile.name || ConfigToJson(shipped) == ConfigToJson(profile)) continue;
      throw Error(ErrorKind::kUsage, name_or_path + " is named as the shipped profile \"" +
                                         shipped.name +
                                         "\" and has other values; rename the "
                                         "file, for a verdict names its profile");
    }
    return profile;
  }
  throw Error(ErrorKind::kNotFound, "no profile and no file \"" + name_or_path + "\"" +
                                        SuggestNames(name_or_path, names));
}

std::vector<FreeSpaceProfile> LoadProfiles(const std::vector<std::string>& names_or_paths) {
  std::vector<FreeSpaceProfile> profiles;
  for (const std::string& name : names_or_paths) {
    FreeSpaceProfile profile = LoadProfile(name);
    for (const FreeSpaceProfile& other : profiles) {
      if (other.name != profile.name) continue;
      throw Error(ErrorKind::kUsage, "two profiles are named \"" + profile.name +
                                         "\"; name each once, or rename a file, for a verdict "
                                         "names its profile");
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace graspbench
