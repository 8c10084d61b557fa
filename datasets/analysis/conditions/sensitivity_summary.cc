#include "datasets/analysis/conditions/sensitivity_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "core/base/error.h"
#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/summary.h"
#include "datasets/plan/conditions.h"

namespace graspbench {
namespace {

/** Limits are steady in the second digit; all settings together take some seconds. */
constexpr int kNumPairResamples = 999;

struct Measure {
  const char* key;
  double TrialMeasures::*member;
};
constexpr Measure kMeasures[] = {
    {"gct_s", &TrialMeasures::gct},           {"gft_s", &TrialMeasures::gft},
    {"gft_ratio", &TrialMeasures::gft_ratio}, {"got_ratio", &TrialMeasures::got_ratio},
    {"sigma_n", &TrialMeasures::sigma},
};

/** Two trials of the same draws. */
struct Pair {
  TrialMeasures before, after;
};
/** The pairs of one hand, one object and one grasp. */
using CellPairs = std::vector<Pair>;

/** The values of both sides of the pairs that have both, by cell. */
struct PairedValues {
  std::vector<std::vector<double>> before, after;
  int num_pairs = 0;

  PairedValues(const std::vector<CellPairs>& cells, double TrialMeasures::*member) {
    for (const CellPairs& cell : cells) {
      std::vector<double> cell_before, cell_after;
      for (const Pair& pair : cell) {
        const double x = pair.before.*member, y = pair.after.*member;
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        cell_before.push_back(x);
        cell_after.push_back(y);
      }
      num_pairs += static_cast<int>(cell_before.size());
      if (cell_before.empty()) continue;
      before.push_back(std::move(cell_before));
      after.push_back(std::move(cell_after));
    }
  }
};

double CalcMedianOf(const std::vector<std::vector<double>>& cells,
                    const std::vector<size_t>& members) {
  std::vector<double> values;
  for (const size_t member : members) {
    values.insert(values.end(), cells[member].begin(), cells[member].end());
  }
  return CalcMedian(std::move(values));
}

MeasureChange CompareMeasure(const std::vector<CellPairs>& cells, const Measure& measure,
                             const std::string& id) {
  const PairedValues values(cells, measure.member);
  MeasureChange change;
  change.measure = measure.key;
  change.num_pairs = values.num_pairs;
  if (values.num_pairs == 0) {
    change.no_interval = "no pair has it twice";
    return change;
  }
  std::vector<size_t> all(values.before.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = i;
  change.before = CalcMedianOf(values.before, all);
  change.after = CalcMedianOf(values.after, all);
  if (values.before == values.after) {
    change.no_interval = "no trial changes";
    return change;
  }
  const Answer<BootstrapInterval> interval = CalcBootstrap(
      values.before.size(),
      [&](const std::vector<size_t>& members) {
        return CalcMedianOf(values.after, members) - CalcMedianOf(values.before, members);
      },
      id + " " + measure.key, kNumPairResamples);
  if (interval) {
    change.low = interval->interval.low;
    change.high = interval->interval.high;
  } else {
    change.no_interval = interval.reason();
  }
  return change;
}

SettingChange Compare(const std::string& setting, const std::string& hand,
                      const std::vector<CellPairs>& cells) {
  SettingChange change;
  change.setting = setting;
  change.hand = hand;
  PairedCounts& counts = change.successes;
  for (const CellPairs& cell : cells) {
    for (const Pair& pair : cell) {
      counts.Add(IsSuccess(pair.before.outcome), IsSuccess(pair.after.outcome));
    }
  }
  const Interval interval = CalcPairedDifferenceInterval(counts);
  change.rate_change_low = interval.low;
  change.rate_change_high = interval.high;
  for (const Measure& measure : kMeasures) {
    change.measures.push_back(CompareMeasure(cells, measure, setting + " " + hand));
  }
  return change;
}

/** The pairs of each hand that has a trial among them, by cell; in the plan's order. */
std::vector<std::pair<std::string, std::vector<CellPairs>>> ListPairs(const Session& session,
                                                                      const VariedTrials& trials) {
  std::vector<std::pair<std::string, std::vector<CellPairs>>> hands;
  std::tuple<std::string, std::string, std::string> cell_before;
  for (const TrialRecord& record : session.records) {
    const auto varied = trials.find(record.plan.id);
    if (varied == trials.end()) continue;
    const PlannedTrial& plan = record.plan;
    if (hands.empty() || hands.back().first != plan.hand) hands.push_back({plan.hand, {}});
    if (varied->second.outcome == Outcome::kNotRun) continue;
    const std::tuple cell(plan.hand, plan.object, plan.grasp);
    if (cell != cell_before) hands.back().second.emplace_back();
    cell_before = cell;
    hands.back().second.back().push_back({MakeTrialMeasures(record.result), varied->second});
  }
  return hands;
}

void CountLeftOut(const Session& session, const VariedTrials& trials, SettingChange& change) {
  std::set<std::string> finished;
  for (const TrialRecord& record : session.records) finished.insert(record.plan.id);
  int num_unfinished = 0, num_without_pair = 0;
  for (const PlannedTrial& planned : session.plan) {
    const auto varied = trials.find(planned.id);
    if (planned.hand != change.hand || varied == trials.end()) continue;
    if (finished.count(planned.id) == 0) {
      ++num_unfinished;
    } else if (varied->second.outcome == Outcome::kNotRun) {
      ++num_without_pair;
    }
  }
  change.num_left_out = num_unfinished + num_without_pair;
  const auto add = [&](int num, const char* why) {
    if (num == 0) return;
    change.why_left_out +=
        (change.why_left_out.empty() ? "" : ", ") + std::to_string(num) + " " + why;
  };
  add(num_unfinished, "not finished in the session");
  add(num_without_pair, "without a trial under the setting");
}

}  // namespace

const MeasureChange& SettingChange::Find(const std::string& measure) const {
  const auto found =
      std::find_if(measures.begin(), measures.end(),
                   [&](const MeasureChange& change) { return change.measure == measure; });
  GRASPBENCH_DEMAND(found != measures.end(), measure);
  return *found;
}

std::string FormatSetting(const std::string& setting) {
  constexpr size_t kLongNumber = 9;            // characters
  const size_t start = setting.find('=') + 1;  // 0 without one
  const std::string_view text = std::string_view(setting).substr(start);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || text.size() < kLongNumber) return setting;
  return setting.substr(0, start) + fmt::format("{:.4g}", value);
}

std::string CountPairs(const SettingChange& change) {
  const int num_pairs = change.successes.num_pairs();
  return FormatCountOf(num_pairs, num_pairs + change.num_left_out);
}

std::string FormatChange(const SettingChange& change, const char* measure, double scale,
                         int decimals) {
  const MeasureChange& part = change.Find(measure);
  const int num_pairs = change.successes.num_pairs();
  std::string text =
      FormatWithRange(scale * part.change(), scale * part.low, scale * part.high, decimals);
  if (part.num_pairs < num_pairs) {
    text += ", " + std::to_string(part.num_pairs) + " of " + FormatCount(num_pairs, "pair");
  }
  return text;
}

std::string DescribeChanges(const std::vector<SettingChange>& changes) {
  const auto lacks_values = [](const SettingChange& change) {
    const int num_pairs = change.successes.num_pairs();
    return std::any_of(
        change.measures.begin(), change.measures.end(),
        [num_pairs](const MeasureChange& measure) { return measure.num_pairs < num_pairs; });
  };
  return std::string(
             "changes of the success rate and of medians, with 95 % intervals, on the same "
             "draws\n") +
         (std::any_of(changes.begin(), changes.end(), lacks_values)
              ? "n of N pairs: in each other pair a trial has no value\n"
              : "");
}

std::vector<SettingChange> ListChanges(const Session& session, const std::string& setting,
                                       const VariedTrials& trials) {
  std::vector<SettingChange> changes;
  for (const auto& [hand, cells] : ListPairs(session, trials)) {
    changes.push_back(Compare(setting, hand, cells));
    CountLeftOut(session, trials, changes.back());
  }
  return changes;
}

SensitivitySummary SummariseSensitivity(const Session& session, const SensitivityData& data) {
  SensitivitySummary summary;
  for (const auto& [setting, trials] : data) {
    for (SettingChange& change : ListChanges(session, setting, trials)) {
      change.value = FindBaseLevel(session.config, setting.substr(0, setting.find('=')));
      summary.changes.push_back(std::move(change));
    }
  }
  summary.offsets = ListOffsetClasses(session, data);
  return summary;
}

}  // namespace graspbench
