#include "datasets/judged_grasps/grasp_store.h"

#include "core/base/config.h"
#include "core/base/text/record_fields.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kJournal[] = "journal.jsonl";

std::vector<CsvColumn<JudgedGrasp>> ListColumns() {
  std::vector<CsvColumn<JudgedGrasp>> columns;
  AddFieldColumns<JudgedGrasp>([](const JudgedGrasp& j) -> const JudgedGrasp& { return j; },
                               columns);
  AddFieldColumns<FreeSpaceResult>(
      [](const JudgedGrasp& j) -> const FreeSpaceResult& { return j.result; }, columns);
  return columns;
}

}  // namespace

std::string JudgedGrasp::Format(const JudgedGrasp& record) {
  return FormatCheckedLine(RecordToJson(record));
}

JudgedGrasp JudgedGrasp::Parse(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    JudgedGrasp record;
    ReadRecord(json, record);
    return record;
  });
}

bool HasJudgedGrasps(const fs::path& folder) { return HasFrozen(kJudgedGraspStore, folder); }

void CreateJudgedGrasps(const fs::path& folder, const Json& config) {
  WriteFrozen(kJudgedGraspStore, folder, config);
}

void CheckSameGrasps(const fs::path& folder, const Json& config) {
  const Json there = LoadFrozen(kJudgedGraspStore, folder).config;
  std::vector<std::string> differences;
  for (const auto& [key, value] : config.items()) {
    if (!there.contains(key) || there.at(key) != value) differences.push_back(key);
  }
  for (const auto& [key, value] : there.items()) {
    if (!config.contains(key)) differences.push_back(key);
  }
  if (differences.empty()) return;
  throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                     "\" was begun with other inputs or settings; what differs:" +
                                     ListDifferences(differences) +
                                     "\nuse those, or choose another folder with --out");
}

Json LoadGraspConfig(const fs::path& folder) {
  return LoadFrozen(kJudgedGraspStore, folder).config;
}

std::vector<JudgedGrasp> LoadJudgedGrasps(const fs::path& folder) {
  LoadFrozen(kJudgedGraspStore, folder);
  Diagnostics findings;
  std::vector<Damage> damage;
  std::vector<JudgedGrasp> judged = LoadAnswers<JudgedGrasp>(folder / kJournal, findings, damage);
  RefuseAnswers(folder, damage, OnDamage::kRefuse);
  return judged;
}

void FinishJudgedGrasps(const fs::path& folder, const std::vector<JudgedGrasp>& judged) {
  WriteDerived(kJudgedGraspStore, folder,
               {{kGraspTable, FormatCsv(ListColumns(), judged)},
                {"grasps.schema.json", FormatJson(MakeTableSchema(ListColumns(), ""), 2) + "\n"}});
}

}  // namespace graspbench
