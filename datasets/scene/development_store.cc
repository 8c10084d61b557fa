#include "datasets/scene/development_store.h"

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

Json MakeDevelopedJson(const DevelopedGrasp& developed) {
  const ProposedGrasp& proposed = developed.proposed;
  Json check = Json::array();
  for (const DevelopTrial& trial : developed.check) check.push_back(RecordToJson(trial));
  return Json{{"grasp", ToJson(developed.grasp)},
              {"proposed", ToJson(proposed.grasp)},
              {"aim",
               {{"opening_m", proposed.aim.opening},
                {"meeting_m", proposed.aim.meeting},
                {"thumb_share", proposed.aim.thumb_share},
                {"reach_m", proposed.aim.reach},
                {"lift_rad", proposed.aim.lift},
                {"tips_down", proposed.aim.tips_down},
                {"grip_n", proposed.grip}}},
              {"miss", proposed.miss},
              {"proposed_score", developed.proposed_score},
              {"score", developed.score},
              {"trials", developed.num_trials},
              {"numerical_failures", developed.num_numerical_failures},
              {"check_successes", CountSuccesses(developed.check)},
              {"check", check}};
}

}  // namespace

bool HasDevelopment(const fs::path& folder) { return HasFrozen(kDevelopmentStore, folder); }

void CreateDevelopment(const fs::path& folder, const DevelopmentConfig& config) {
  WriteFrozen(kDevelopmentStore, folder, ConfigToJson(config));
}

void CheckSameDevelopment(const fs::path& folder, const DevelopmentConfig& config) {
  const auto there = ParseFrozen<DevelopmentConfig>(kDevelopmentStore, folder,
                                                    LoadFrozen(kDevelopmentStore, folder).config);
  const std::string text = ListDifferences(FindConfigDifferences(there, config));
  if (text.empty()) return;
  throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                     "\" was started with another hand or other settings (there "
                                     "and now):" +
                                     text + "\nuse those, or choose another folder with --out");
}

void WriteDevelopmentResult(const fs::path& folder, const Hand& hand,
                            const std::vector<DevelopedGrasp>& developed) {
  Json grasps = Json::array();
  for (const DevelopedGrasp& one : developed) grasps.push_back(MakeDevelopedJson(one));
  const Json result = {{"hand", hand.id}, {"grasps", grasps}};
  WriteFileAtomically(folder / "result.json", FormatJson(result, 2) + "\n");
  SealStore(kDevelopmentStore, folder);
}

std::string DevelopmentRecord::Format(const DevelopmentRecord& record) {
  return FormatCheckedLine(RecordToJson(record));
}

DevelopmentRecord DevelopmentRecord::Parse(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    DevelopmentRecord record;
    ReadRecord(json, record);
    return record;
  });
}

}  // namespace graspbench
