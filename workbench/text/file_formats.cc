#include "workbench/text/file_formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/config.h"
#include "core/grasp/grasp_keys.h"
#include "core/hand/hand_yaml.h"
#include "core/hand/tactile_yaml.h"
#include "datasets/judged_grasps/profile_file.h"
#include "datasets/pipeline/pipeline_file.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/sweep_design.h"
#include "human_study/study/design/study_config.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

/** Where a key may be set: the files that describe it with one row. */
struct ExplainedKey {
  FileKey row;
  std::vector<std::string> files;
};

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Of one key in two files. */
bool AreEqual(const FileKey& a, const FileKey& b) {
  return a.fallback == b.fallback && a.meaning == b.meaning && FormatRange(a) == FormatRange(b);
}

std::vector<ExplainedKey> FindKeys(const std::string& key) {
  std::vector<ExplainedKey> found;
  for (const FileFormat& format : ListFileFormats()) {
    const FileKey* row = FindFileKey(format.keys, key);
    if (row == nullptr) continue;
    const auto same = std::find_if(found.begin(), found.end(), [row](const ExplainedKey& each) {
      return AreEqual(each.row, *row);
    });
    if (same == found.end()) {
      found.push_back({*row, {format.name}});
    } else {
      same->files.push_back(format.name);
    }
  }
  return found;
}

std::string FormatKey(const ExplainedKey& key) {
  const FileKey& row = key.row;
  std::string text = row.key + "\n  " + row.meaning + "\n";
  const auto add = [&text](const char* heading, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<8} {}\n", heading, value);
  };
  const std::string unit = FindUnit(row.key), range = FormatRange(row);
  add("unit", unit.empty() && !range.empty() ? "none" : unit);
  add("range", range);
  add("default", row.fallback == kRequired ? "none, required"
                 : row.fallback.empty()    ? "none, may be left out"
                                           : row.fallback);
  add("set in", fmt::format("{}", fmt::join(key.files, ", ")));
  if (Contains(key.files, "session.yaml") && Contains(ListConfigKeys(SessionConfig()), row.key)) {
    add("or by", "graspbench run --set " + row.key + "=VALUE");
  }
  return text;
}

}  // namespace

const std::vector<FileFormat>& ListFileFormats() {
  static const std::vector<FileFormat> formats = [] {
    FileKeys hand = ListHandKeys();
    hand.insert(hand.end(), ListHandGraspKeys().begin(), ListHandGraspKeys().end());
    return std::vector<FileFormat>{
        {"object.yaml", "a thing to grasp, beside its mesh", ListObjectKeys()},
        {"hand.yaml", "what hand.urdf beside it cannot say", hand},
        {"tactile.yaml", "what a hand feels with, beside its hand.yaml; not needed",
         ListTactileKeys()},
        {"session.yaml",
         "what graspbench run simulates; its session.json has all that matter and is read, "
         "too",
         ListSessionKeys()},
        {"sweep.yaml", "a session under many conditions, for graspbench sweep", ListSweepKeys()},
        {"study.yaml", "a study of people's grasps, for graspbench study run", ListStudyKeys()},
        {"grasp.yaml", "a grasp of its own file, for graspbench run --grasp FILE",
         ListGraspFileKeys()},
        {"profile.yaml", "how somebody judges grasps, for graspbench grasps judge --profile FILE",
         ListProfileKeys()},
        {"pipeline.yaml", "stages that make results, for graspbench pipeline run",
         ListPipelineKeys()},
    };
  }();
  return formats;
}

std::string ExplainFileKey(const std::string& key) {
  std::string text;
  for (const ExplainedKey& each : FindKeys(key)) text += FormatKey(each);
  return text;
}

std::string SuggestFileKeys(const std::string& misspelt, std::vector<std::string> names) {
  for (const FileFormat& format : ListFileFormats()) {
    for (const FileKey& row : format.keys) {
      if (row.key.substr(row.key.rfind('.') + 1) == misspelt) {
        return "; did you mean \"" + row.key + "\"?";
      }
      names.push_back(row.key);
    }
  }
  return SuggestNames(misspelt, names);
}

}  // namespace graspbench
