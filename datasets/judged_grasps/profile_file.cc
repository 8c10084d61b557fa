#include "datasets/judged_grasps/profile_file.h"

#include <algorithm>
#include <filesystem>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "datasets/plan/session_config.h"

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
                          "expected 0: acceleration_m_per_s2 states what acts on the object");
  }
  return problems;
}

fs::path FindProfileFolder() { return FindDataRoot() / "datasets" / "profiles"; }

}  // namespace

const FileKeys& ListProfileKeys() {
  static const FileKeys keys = [] {
    FileKeys rows = DescribeConfig(FreeSpaceProfile());
    for (FileKey& row : rows) {
      if (row.key != "sim.gravity_m_per_s2") continue;
      row.meaning = "0: acceleration_m_per_s2 says what acts on the object";
      row.low = row.high = 0.0;
    }
    return rows;
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
