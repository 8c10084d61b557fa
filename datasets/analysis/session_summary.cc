#include "datasets/analysis/session_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "core/trial/measures/object_in_hand.h"

namespace graspbench {

TimingRatios SummariseTimings(const std::vector<ContactTiming>& timings) {
  std::vector<double> gft, got;
  for (const ContactTiming& timing : timings) {
    gft.push_back(timing.gft_ratio);
    got.push_back(timing.got_ratio);
  }
  TimingRatios ratios = {CalcSummary(gft), CalcSummary(got), 0};
  const int num_with_gft = ratios.gft ? ratios.gft->count : 0;
  ratios.num_without_gft = static_cast<int>(timings.size()) - num_with_gft;
  return ratios;
}

std::vector<TimingGroup> ListTimingGroups(const Session& session) {
  const SessionSummary summary = SummariseSession(session);
  std::vector<TimingGroup> groups;
  for (const std::string& hand : summary.hands) {
    std::vector<ContactTiming> all;
    std::vector<TimingGroup> by_grasp;
    for (const std::string& grasp : summary.grasps) {
      std::vector<ContactTiming> timings;
      for (const TrialRecord& record : session.records) {
        if (record.plan.hand != hand || record.plan.grasp != grasp) continue;
        if (record.result.outcome == Outcome::kNumericalFailure) continue;
        timings.push_back(record.result.timing);
      }
      if (timings.empty()) continue;
      by_grasp.push_back({hand, grasp, SummariseTimings(timings)});
      all.insert(all.end(), timings.begin(), timings.end());
    }
    // One grasp is all there is: said once, by its name.
    if (by_grasp.size() != 1) groups.push_back({hand, "", SummariseTimings(all)});
    groups.insert(groups.end(), by_grasp.begin(), by_grasp.end());
  }
  return groups;
}

namespace {

size_t IndexOf(Outcome outcome) {
  const std::vector<Outcome>& all = ListOutcomes();
  const auto found = std::find(all.begin(), all.end(), outcome);
  GRASPBENCH_DEMAND(found != all.end() && all.size() == kNumOutcomes, NameOf(outcome));
  return static_cast<size_t>(found - all.begin());
}

// NaN stands for "nothing yet", so the first value always wins.
void RaiseTo(double value, double& worst) {
  if (std::isfinite(value) && !(worst >= value)) worst = value;
}

Tally EmptyTally() {
  Tally tally;
  tally.worst_penetration = tally.worst_energy_residual = std::numeric_limits<double>::quiet_NaN();
  return tally;
}

void AddUnknown(const std::string& name, std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

struct TimeSamples {
  std::vector<double> gct, gft, got, gft_ratio, got_ratio;

  void Add(const ContactTiming& timing) {
    gct.push_back(timing.gct);
    gft.push_back(timing.gft);
    got.push_back(timing.got);
    gft_ratio.push_back(timing.gft_ratio);
    got_ratio.push_back(timing.got_ratio);
  }
  ContactTimes Summarise() const {
    return {CalcSpread(gct), CalcSpread(gft), CalcSpread(got), CalcSpread(gft_ratio),
            CalcSpread(got_ratio)};
  }
};

void FinishCell(CellSummary& cell) {
  TimeSamples kept, reseated;
  std::map<std::string, int> orders;
  for (const TrialRecord* record : cell.records) {
    const TrialResult& result = record->result;
    cell.tally.Count(result.outcome);
    cell.tally.num_steps += result.num_steps;
    cell.tally.num_unconverged += result.num_unconverged;
    if (IsNumericalFailure(result.outcome)) continue;
    RaiseTo(result.worst_penetration, cell.tally.worst_penetration);
    RaiseTo(std::abs(result.energy_residual), cell.tally.worst_energy_residual);
    if (result.timing.contact_before_start) {
      ++cell.num_early;  // a class of its own: its closure began with a touch
    } else {
      (FindSeat(result) == Seat::kReseated ? reseated : kept).Add(result.timing);
    }
    if (const std::string order = FindContactOrder(result).Format(); !order.empty()) {
      ++orders[order];
    }
  }
  cell.times = kept.Summarise();
  cell.reseated_times = reseated.Summarise();
  cell.orders.assign(orders.begin(), orders.end());
  std::stable_sort(cell.orders.begin(), cell.orders.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
}

}  // namespace

void AddTally(const Tally& part, Tally& sum) {
  sum.planned += part.planned;
  sum.finished += part.finished;
  for (size_t i = 0; i < kNumOutcomes; ++i) sum.outcomes[i] += part.outcomes[i];
  RaiseTo(part.worst_penetration, sum.worst_penetration);
  RaiseTo(part.worst_energy_residual, sum.worst_energy_residual);
  sum.num_steps += part.num_steps;
  sum.num_unconverged += part.num_unconverged;
}

Spread CalcSpread(std::vector<double> values) {
  values.erase(
      std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
      values.end());
  constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {0, kNoValue, kNoValue, kNoValue};
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return {static_cast<int>(values.size()), CalcMedian(values), *lowest, *highest};
}

void Tally::Count(Outcome outcome) {
  ++finished;
  ++outcomes[IndexOf(outcome)];
}

int Tally::CountOf(Outcome outcome) const { return outcomes[IndexOf(outcome)]; }

double Tally::rate() const { return CalcShare(successes(), finished); }

Outcome Tally::most_frequent_failure() const {
  Outcome worst = Outcome::kNoContact;
  for (const Outcome outcome : ListOutcomes()) {
    if (outcome != Outcome::kSuccess && CountOf(outcome) > CountOf(worst)) worst = outcome;
  }
  return worst;
}

double Tally::share_unconverged() const { return CalcShare(num_unconverged, num_steps); }

Interval Tally::rate_interval() const { return CalcWilsonInterval(successes(), finished); }

std::string FormatRate(const Tally& tally) { return FormatRate(tally.successes(), tally.finished); }

std::string FormatRateInterval(const Tally& tally) {
  return FormatRateInterval(tally.successes(), tally.finished);
}

Spread CalcContactSpread(const CellSummary& cell, const std::string& digit) {
  std::vector<double> times;
  for (const TrialRecord* record : cell.records) {
    for (const DigitContact& contact : record->result.contacts) {
      if (contact.digit == digit) times.push_back(contact.time);
    }
  }
  return CalcSpread(times);
}

const CellSummary* SessionSummary::FindCell(const std::string& hand, const std::string& object,
                                            const std::string& grasp) const {
  const auto place = places.find({hand, object, grasp});
  return place == places.end() ? nullptr : &cells[place->second];
}

Tally SessionSummary::TallyOf(const std::string& hand, const std::string& grasp) const {
  Tally sum = EmptyTally();
  for (const CellSummary& cell : cells) {
    if (cell.hand == hand && (grasp.empty() || cell.grasp == grasp)) AddTally(cell.tally, sum);
  }
  return sum;
}

std::string DescribeGrasp(const CellSummary& cell) {
  std::map<std::string, int> counts;
  for (const TrialRecord* record : cell.records) {
    if (record->result.sight_grasp) ++counts[*record->result.sight_grasp];
  }
  std::vector<std::pair<std::string, int>> chosen(counts.begin(), counts.end());
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [grasp, count] : chosen) {
    text += (text.empty() ? ": " : ", ") + std::to_string(count) + " " + grasp;
  }
  return cell.grasp + text;
}

SessionSummary SummariseSession(const Session& session) {
  SessionSummary summary;
  for (const PlannedTrial& trial : session.plan) {
    if (trial.condition) continue;
    const auto [place, is_new] =
        summary.places.insert({{trial.hand, trial.object, trial.grasp}, summary.cells.size()});
    if (is_new) {
      AddUnknown(trial.hand, summary.hands);
      AddUnknown(trial.object, summary.objects);
      AddUnknown(trial.grasp, summary.grasps);
      CellSummary cell;
      cell.hand = trial.hand;
      cell.object = trial.object;
      cell.grasp = trial.grasp;
      cell.key = MakePlainKey({trial.hand, trial.object, trial.grasp});
      cell.tally = EmptyTally();
      summary.cells.push_back(cell);
    }
    ++summary.cells[place->second].tally.planned;
  }
  std::sort(summary.grasps.begin(), summary.grasps.end());
  for (const TrialRecord& record : session.records) {
    if (record.plan.condition) continue;
    const auto found =
        summary.places.find({record.plan.hand, record.plan.object, record.plan.grasp});
    GRASPBENCH_DEMAND(found != summary.places.end(),
                      "a record that is not in the plan: " + record.plan.id);
    summary.cells[found->second].records.push_back(&record);
  }
  summary.total = EmptyTally();
  for (CellSummary& cell : summary.cells) {
    FinishCell(cell);
    AddTally(cell.tally, summary.total);
  }
  summary.differences = CompareHands(session, summary.hands);
  return summary;
}

}  // namespace graspbench
