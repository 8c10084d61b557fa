#include "workbench/tables/comparison_tables.h"

#include "core/base/text/text.h"
#include "datasets/session/find_trial.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes) {
  if (changes.empty()) return "";
  return "\n" + FormatTable(ShowTable(ListThresholdChangeColumns(), changes)) +
         "median ratio of the grip thresholds over draws, with 95 % interval\n";
}

namespace {

constexpr size_t kMaxListed = 20;  // trials won, and lost, on the terminal

std::string FormatChanges(const std::vector<SettingChange>& changes) {
  return FormatTable(ShowChanges(
             changes, {"of", "hand", "pairs", "objects", "improved", "worsened", "success [%]",
                       "GFT [ms]", "GFT% [%]", "sigma [N]", "left out"})) +
         DescribeChanges(changes);
}

std::string FormatPair(const TrialPair& pair) {
  const std::string before = NameTrial(pair.before->plan), after = NameTrial(pair.after->plan);
  return before + (after == before ? "" : " and " + after) + ": " +
         NameOf(pair.before->result.outcome) + ", then " + NameOf(pair.after->result.outcome) +
         "\n";
}

std::string FormatFlips(const std::vector<TrialPair>& pairs, const char* heading,
                        bool (TrialPair::*is_shown)() const) {
  std::string text;
  size_t count = 0;
  for (const TrialPair& pair : pairs) {
    if ((pair.*is_shown)() && ++count <= kMaxListed) text += "  " + FormatPair(pair);
  }
  if (count > kMaxListed) text += "  .. and " + std::to_string(count - kMaxListed) + " more\n";
  return count == 0 ? "" : std::string(heading) + "\n" + text;
}

Json ListFlips(const std::vector<TrialPair>& pairs, bool (TrialPair::*is_shown)() const) {
  Json list = Json::array();
  for (const TrialPair& pair : pairs) {
    if (!(pair.*is_shown)()) continue;
    list.push_back({{"before", pair.before->plan.id},
                    {"after", pair.after->plan.id},
                    {"name", NameTrial(pair.before->plan)},
                    {"outcome_before", NameOf(pair.before->result.outcome)},
                    {"outcome_after", NameOf(pair.after->result.outcome)}});
  }
  return list;
}

/** Success object by object, and whether it differs. */
std::string FormatObjects(const std::vector<ObjectComparison>& objects,
                          const std::vector<HandDecision>& decisions) {
  if (objects.size() < 2) {
    return "p: not testable with one object; the exact test clustered by object needs 6 or more\n";
  }
  return "\n" + FormatTable(ShowTable(ListObjectComparisonColumns(), objects)) +
         "both fail [%]: share of the pairs in which both trials fail, with 95 % interval\n\n" +
         FormatTable(ShowTable(ListHandDecisionColumns(), decisions)) +
         "p: equal success rates, exact test clustered by object (with fewer than 6 objects it "
         "cannot be significant)\npairs for 10 points: number of pairs that detects 10 points with "
         "a power of 80 % on these objects; more objects: no number of pairs on these objects "
         "does\n";
}

std::string FormatLoads(const std::vector<LoadChange>& loads) {
  if (loads.empty()) return "";
  return "\n" + FormatTable(ShowTable(ListLoadChangeColumns(), loads)) +
         "smallest breaking force over draws judged in both sessions, with 95 % interval\n";
}

std::string FormatTypes(const char* which, const std::vector<TypeSummary>& types) {
  const std::string line = FormatTypeLine(types);
  const std::string table = FormatTable(ShowTable(ListTypeColumns(), types));
  return line.empty() ? "" : std::string("\n") + which + ": " + line + "\n" + table;
}

/** Hands of the first session become "B minus A" where hands are compared. */
template <class Row>
std::vector<Row> NameBothHands(std::vector<Row> rows, const SessionComparison& comparison) {
  if (comparison.hand.empty()) return rows;
  for (Row& row : rows) row.hand = comparison.other_hand + " minus " + comparison.hand;
  return rows;
}

}  // namespace

ComparedSessions CompareAll(const Session& before, const Session& after) {
  ComparedSessions result;
  result.comparison = CompareSessions(before, after);
  const std::vector<TrialPair>& pairs = result.comparison.pairs;
  result.thresholds = CompareThresholds(pairs, LoadThresholds(before), LoadThresholds(after));
  result.objects = CompareObjects(pairs);
  result.decisions = DecideByObject(result.objects);
  result.loads = CompareLoads(pairs);
  result.types_before = ListTypeSummaries(before);
  result.types_after = ListTypeSummaries(after);
  return result;
}

Json ToJson(const ComparedSessions& result) {
  const SessionComparison& comparison = result.comparison;
  Json changes = Json::array();
  for (const SettingChange& change : comparison.changes) {
    changes.push_back(RecordToJson(change));
    changes.back().erase("session_value");  // of a sensitivity; settings stand above
  }
  return {{"pairs", comparison.pairs.size()},
          {"other_grasp", comparison.num_other_grasp()},
          {"hand", comparison.hand},
          {"other_hand", comparison.other_hand},
          {"only_before", comparison.num_only_before},
          {"only_after", comparison.num_only_after},
          {"settings", comparison.settings},
          {"changes", changes},
          {"thresholds", MakeJsonRows(ListThresholdChangeColumns(), result.thresholds)},
          {"objects", MakeJsonRows(ListObjectComparisonColumns(), result.objects)},
          {"decisions", MakeJsonRows(ListHandDecisionColumns(), result.decisions)},
          {"loads", MakeJsonRows(ListLoadChangeColumns(), result.loads)},
          {"types_before", MakeJsonRows(ListTypeColumns(), result.types_before)},
          {"types_after", MakeJsonRows(ListTypeColumns(), result.types_after)},
          {"won", ListFlips(comparison.pairs, &TrialPair::is_won)},
          {"lost", ListFlips(comparison.pairs, &TrialPair::is_lost)}};
}

std::string FormatComparison(const ComparedSessions& result) {
  const SessionComparison& comparison = result.comparison;
  const std::string num_pairs = FormatCount(static_cast<int64_t>(comparison.pairs.size()), "pair");
  std::string text = num_pairs + " of the same draw";
  if (!comparison.hand.empty()) {
    text += ", first " + comparison.hand + ", second " + comparison.other_hand;
  }
  text += "; " + std::to_string(comparison.num_only_before) + " trials are only in the first, " +
          std::to_string(comparison.num_only_after) + " only in the second\n";
  if (const int num = comparison.num_other_grasp(); num > 0)
    text += std::to_string(num) + " of " + num_pairs + " changed grasp\n";
  if (!comparison.settings.empty()) text += "settings that differ (first, second)\n";
  for (const std::string& setting : comparison.settings) text += "  " + setting + "\n";
  return text + FormatChanges(NameBothHands(comparison.changes, comparison)) +
         FormatObjects(NameBothHands(result.objects, comparison),
                       NameBothHands(result.decisions, comparison)) +
         FormatThresholdChanges(NameBothHands(result.thresholds, comparison)) +
         FormatLoads(NameBothHands(result.loads, comparison)) +
         FormatTypes("before", result.types_before) + FormatTypes("after", result.types_after) +
         FormatFlips(comparison.pairs, "improved", &TrialPair::is_won) +
         FormatFlips(comparison.pairs, "worsened", &TrialPair::is_lost);
}

}  // namespace graspbench
