#include "datasets/judged_grasps/grasp_store.h"

#include "core/base/config.h"
#include "core/base/text/csv.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kJournal[] = "journal.jsonl";

const std::vector<CsvColumn<JudgedGrasp>>& ListColumns() {
  using J = const JudgedGrasp&;
  static const std::vector<CsvColumn<JudgedGrasp>> columns = {
      {"source", "string", "", "file of the grasp", [](J j) { return Json(j.source); }},
      {"index", "integer", "", "of the grasp in its file", [](J j) { return Json(j.index); }},
      {"object", "string", "", "as the file names it", [](J j) { return Json(j.object); }},
      {"profile", "string", "", "whose rules", [](J j) { return Json(j.profile); }},
      {"jitter", "integer", "", "0: as it is; else the number of the disturbance",
       [](J j) { return Json(j.jitter); }},
      {"label", "string", "", "the file's own verdict", [](J j) { return Json(j.label); }},
      {"passed", "boolean", "", "verdict", [](J j) { return Json(int{j.result.passed}); }},
      {"failed_stage", "string", "", "where it failed",
       [](J j) { return Json(j.result.failed_stage); }},
      {"reason", "string", "", "why", [](J j) { return Json(j.result.reason); }},
      {"num_beyond_limits", "integer", "", "joints that a stage asks for more than their limits",
       [](J j) { return Json(j.result.num_beyond_limits); }},
      {"start_penetration_m", "number", "m", "of hand and object at the first stage",
       [](J j) { return JsonNumber(j.result.start_penetration); }},
      {"self_penetration_m", "number", "m", "of the hand in itself at the second stage",
       [](J j) { return JsonNumber(j.result.self_penetration); }},
      {"touching", "string", "", "digits on the object after the last stage",
       [](J j) { return Json(j.result.touching); }},
      {"grip_force_n", "number", "N", "sum of normal forces then",
       [](J j) { return JsonNumber(j.result.grip_force); }},
      {"epsilon", "number", "", "of these contacts, ferrari-canny; 0: no force closure",
       [](J j) { return JsonNumber(j.result.epsilon); }},
      {"closing_shift_m", "number", "m", "of the object until then",
       [](J j) { return JsonNumber(j.result.closing_shift); }},
      {"breaking_load_n", "number", "N",
       "largest push stood along all six axes, to 5 %; 0: not sought, or none",
       [](J j) { return JsonNumber(j.result.breaking_load); }},
      {"breaks_along", "string", "",
       "the push along which more breaks it; empty with a load: 16 times the profile's did not",
       [](J j) { return Json(j.result.breaks_along); }},
      {"num_stood", "integer", "", "pushes or lifts that it stood",
       [](J j) { return Json(j.result.num_stood); }},
      {"worst_shift_m", "number", "m", "of the object, in all looks",
       [](J j) { return JsonNumber(j.result.worst_shift); }},
      {"worst_turn_deg", "number", "deg", "turn of the object, in all looks",
       [](J j) { return JsonNumber(j.result.worst_turn_deg); }}};
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
