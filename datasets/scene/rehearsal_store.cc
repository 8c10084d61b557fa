#include "datasets/scene/rehearsal_store.h"

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kRehearsalJournal[] = "journal.jsonl";

/** A row of candidates.csv. */
struct CandidateRow {
  const RehearsedPair* pair;
  size_t number;

  const RehearsedCandidate& tried() const { return pair->result.tried[number]; }
};

std::vector<CsvColumn<CandidateRow>> ListCandidateColumns() {
  using Row = CandidateRow;
  return {
      {"hand", "", "id of the hand", [](const Row& r) { return r.pair->hand; }},
      {"object", "", "id of the object", [](const Row& r) { return r.pair->object; }},
      {"candidate", "", "number in the order of trying, from 0",
       [](const Row& r) { return static_cast<int>(r.number); }},
      {"grasp", "", "id of the standard grasp",
       [](const Row& r) { return r.tried().candidate.standard; }},
      {"approach", "", "approach direction; automatic: chosen by the rule",
       [](const Row& r) -> std::string {
         return RowOf(kApproaches, r.tried().candidate.approach).name;
       }},
      {"yaw_deg", "deg", "rotation of the axes in which the rule places the hand",
       [](const Row& r) { return DegFromRad(r.tried().candidate.place.yaw); }},
      {"rise_m", "m", "height above the rule's",
       [](const Row& r) { return r.tried().candidate.place.rise; }},
      {"along_m", "m", "shift along the first of the turned axes",
       [](const Row& r) { return r.tried().candidate.place.along; }},
      {"opening", "",
       "additional opening of the pre-grasp, share of the distance from target to pre-grasp",
       [](const Row& r) { return r.tried().candidate.opening; }},
      {"draws", "", "number of tested draws",
       [](const Row& r) { return static_cast<int>(r.tried().outcomes.size()); }},
      {"held", "", "of these, held", [](const Row& r) { return r.tried().CountHeld(); }},
      {"grip_threshold", "", "smallest share of the grip that held draw 0; 1 if not searched",
       [](const Row& r) { return r.tried().grip_threshold; }},
      {"chosen", "", "1: the choice",
       [](const Row& r) { return r.pair->result.chosen == static_cast<int>(r.number); }},
      {"reason", "", "reason of its first failure", [](const Row& r) { return r.tried().reason; }}};
}

}  // namespace

std::string RehearsedPair::Format(const RehearsedPair& record) {
  return FormatCheckedLine(RecordToJson(record));
}

RehearsedPair RehearsedPair::Parse(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    RehearsedPair record;
    ReadRecord(json, record);
    const Rehearsal& result = record.result;
    if (result.chosen < 0 || result.chosen >= static_cast<int>(result.tried.size())) {
      throw Error(ErrorKind::kFormat, "candidate " + std::to_string(result.chosen) +
                                          " is chosen of " + std::to_string(result.tried.size()));
    }
    return record;
  });
}

std::vector<RehearsedPair> LoadRehearsals(const fs::path& folder) {
  LoadFrozen(kRehearsalStore, folder);
  Diagnostics findings;
  std::vector<Damage> damage;
  std::vector<RehearsedPair> pairs =
      LoadAnswers<RehearsedPair>(folder / kRehearsalJournal, findings, damage);
  RefuseAnswers(folder, damage, OnDamage::kRefuse);
  return pairs;
}

Json MakeCandidateTableSchema() { return MakeTableSchema(ListCandidateColumns(), ""); }

void FinishRehearsals(const fs::path& folder, const std::vector<RehearsedPair>& pairs,
                      std::map<std::string, std::string> grasps) {
  std::vector<CandidateRow> rows;
  for (const RehearsedPair& pair : pairs) {
    for (size_t i = 0; i < pair.result.tried.size(); ++i) rows.push_back({&pair, i});
  }
  for (const auto& [name, text] : grasps) MakeFolder((folder / name).parent_path());
  grasps[kCandidateTable] = FormatCsv(ListCandidateColumns(), rows);
  grasps["candidates.schema.json"] = FormatJson(MakeCandidateTableSchema(), 2) + "\n";
  WriteDerived(kRehearsalStore, folder, grasps);
}

}  // namespace graspbench
