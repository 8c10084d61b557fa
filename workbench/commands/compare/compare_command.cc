#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/controller_comparison.h"
#include "datasets/analysis/type_summary.h"
#include "datasets/session/find_trial.h"
#include "workbench/command.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes) {
  if (changes.empty()) return "";
  return "\n" + FormatTable(ShowTable(ListThresholdChangeColumns(), changes)) +
         "median ratio of the grip thresholds over draws, with 95 % interval\n";
}

namespace {

constexpr size_t kMaxListed = 20;  // trials won, and lost, on the terminal

struct CompareOptions {
  std::string before, after;
  bool json = false;
};

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
  if (objects.size() < 2) return "";
  return "\n" + FormatTable(ShowTable(ListObjectComparisonColumns(), objects)) + "\n" +
         FormatTable(ShowTable(ListHandDecisionColumns(), decisions)) +
         "p: equal success rates, exact test clustered by object (never below 0.05 with fewer than "
         "6 objects)\npairs for 10 points: number of pairs that detects 10 points with a power of "
         "80 % on these objects\n";
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

void Compare(const CompareOptions& options) {
  const Session before = LoadSession(options.before, OnDamage::kRefuse, RecordParts::kBrief);
  const Session after = LoadSession(options.after, OnDamage::kRefuse, RecordParts::kBrief);
  const SessionComparison comparison = CompareSessions(before, after);
  const std::vector<ThresholdChange> thresholds =
      CompareThresholds(comparison.pairs, LoadThresholds(before), LoadThresholds(after));
  const std::vector<ObjectComparison> objects = CompareObjects(comparison.pairs);
  const std::vector<HandDecision> decisions = DecideByObject(objects);
  const std::vector<LoadChange> loads = CompareLoads(comparison.pairs);
  const auto types_before = ListTypeSummaries(before), types_after = ListTypeSummaries(after);
  if (options.json) {
    Json changes = Json::array();
    for (const SettingChange& change : comparison.changes) {
      changes.push_back(RecordToJson(change));
      changes.back().erase("session_value");  // of a sensitivity; settings stand above
    }
    return PrintJson({{"pairs", comparison.pairs.size()},
                      {"other_grasp", comparison.num_other_grasp()},
                      {"only_before", comparison.num_only_before},
                      {"only_after", comparison.num_only_after},
                      {"settings", comparison.settings},
                      {"changes", changes},
                      {"thresholds", MakeJsonRows(ListThresholdChangeColumns(), thresholds)},
                      {"objects", MakeJsonRows(ListObjectComparisonColumns(), objects)},
                      {"decisions", MakeJsonRows(ListHandDecisionColumns(), decisions)},
                      {"loads", MakeJsonRows(ListLoadChangeColumns(), loads)},
                      {"types_before", MakeJsonRows(ListTypeColumns(), types_before)},
                      {"types_after", MakeJsonRows(ListTypeColumns(), types_after)},
                      {"won", ListFlips(comparison.pairs, &TrialPair::is_won)},
                      {"lost", ListFlips(comparison.pairs, &TrialPair::is_lost)}});
  }
  const std::string num_pairs = FormatCount(static_cast<int64_t>(comparison.pairs.size()), "pair");
  std::string text = num_pairs + " of the same draw; " +
                     std::to_string(comparison.num_only_before) +
                     " trials are only in the first, " + std::to_string(comparison.num_only_after) +
                     " only in the second\n";
  if (const int num = comparison.num_other_grasp(); num > 0)
    text += std::to_string(num) + " of " + num_pairs + " changed grasp\n";
  if (!comparison.settings.empty()) text += "settings that differ (first, second)\n";
  for (const std::string& setting : comparison.settings) text += "  " + setting + "\n";
  PrintResult(text + FormatChanges(comparison.changes) + FormatObjects(objects, decisions) +
              FormatThresholdChanges(thresholds) + FormatLoads(loads) +
              FormatTypes("before", types_before) + FormatTypes("after", types_after) +
              FormatFlips(comparison.pairs, "improved", &TrialPair::is_won) +
              FormatFlips(comparison.pairs, "worsened", &TrialPair::is_lost));
}

}  // namespace

void AddCompareCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "compare", "Compare two sessions trial by trial, on the same draws.",
                    "  graspbench compare results/before results/after\n"
                    "  graspbench compare results/standard results/optimised --json");
  const auto options = std::make_shared<CompareOptions>();
  command.AddRequired("before", options->before, "a session", "DIR");
  command.AddRequired("after", options->after, "the session to compare it with", "DIR");
  AddJsonOption(command, options->json);
  command.SetAction([options] { Compare(*options); });
}

}  // namespace graspbench
