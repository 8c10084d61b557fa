#include "datasets/analysis/conditions/delay_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "core/trial/digit_delays.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {
namespace {

constexpr double kMassShare = 0.25, kFrictionShare = 0.7, kOffsetFactor = 2.0;

struct LateRow {
  LateDigit value;
  const char* name;
};
constexpr LateRow kLateDigits[] = {{LateDigit::kLast, "last"}, {LateDigit::kFirst, "first"}};

/** What the object is like; the first is as run. */
std::vector<Condition> ListStates(const SessionConfig& config) {
  const auto set = [](const char* key, double value) {
    return std::vector<std::string>{std::string(key) + "=" + FormatJson(value)};
  };
  return {{"as run", {}},
          {"light", set("model.mass_scale", kMassShare * config.model.mass_scale)},
          {"slippery", set("model.friction_scale", kFrictionShare * config.model.friction_scale)},
          {"off-centre", set("variation.offset_m", kOffsetFactor * config.variation.offset)}};
}

Condition DelayDigitIn(const Condition& state, const char* late, double delay) {
  Condition condition = state;
  condition.name += std::string(", ") + late + " digit " + FormatJson(delay) + " s late";
  condition.settings.push_back(std::string("delay.") + late + "=" + FormatJson(delay));
  return condition;
}

DelayedTrial MakeDelayedTrial(const std::string& state, const char* late, double delay,
                              const TrialRecord& record, const TrialRecord& undelayed) {
  DelayedTrial trial = {state, late, delay, {}, record};
  trial.record.plan = undelayed.plan;
  trial.closing = record.result.closing.value_or(Displacement());
  trial.record.result.closing.reset();
  return trial;
}

}  // namespace

std::vector<Condition> ListDelayConditions(const SessionConfig& config) {
  std::vector<Condition> conditions;
  for (const Condition& state : ListStates(config)) {
    if (!state.settings.empty()) conditions.push_back(state);
    for (const LateRow& late : kLateDigits) {
      for (const double delay : ListDelays()) {
        if (delay > 0.0) conditions.push_back(DelayDigitIn(state, late.name, delay));
      }
    }
  }
  return conditions;
}

std::vector<DelayedTrial> ListDelayedTrials(const Session& experiment) {
  std::vector<DelayedTrial> trials;
  for (const Condition& state : ListStates(experiment.config)) {
    std::vector<ComparedSide> sides = {
        {&experiment, state.settings.empty() ? std::nullopt : std::optional(state.name)}};
    for (const LateRow& late : kLateDigits) {
      for (const double delay : ListDelays()) {
        if (delay == 0.0) continue;
        sides.push_back({&experiment, DelayDigitIn(state, late.name, delay).name});
      }
    }
    const std::vector<ComparedDraw> draws = ListComparedDraws(sides);
    std::vector<DelayedTrial> undelayed;
    for (const ComparedDraw& draw : draws) {
      const TrialRecord* record = draw.records.front();
      if (!record) continue;
      size_t side = 0;
      for (const LateRow& late : kLateDigits) {
        undelayed.push_back(MakeDelayedTrial(state.name, late.name, 0.0, *record, *record));
        const bool has_late = FindLateDigit(record->result, late.value) != nullptr;
        for (const double delay : ListDelays()) {
          if (delay == 0.0) continue;
          const TrialRecord* delayed = draw.records[++side];
          if (!has_late || !delayed) continue;
          trials.push_back(MakeDelayedTrial(state.name, late.name, delay, *delayed, *record));
        }
      }
    }
    for (DelayedTrial& trial : undelayed) trials.push_back(std::move(trial));
  }
  return trials;
}

namespace {

struct DelayResponse {
  ShownQuantity shown;
  std::function<double(const DelayedTrial&)> value;
};

std::vector<DelayResponse> ListDelayResponses() {
  std::vector<DelayResponse> responses = {
      {{"gft_s", "GFT [ms]", MsFromS(1.0), 0},
       [](const DelayedTrial& trial) {
         const ContactTiming& timing = trial.record.result.timing;
         return timing.contact_before_start ? kUnset : timing.gft;
       }},
      {{"closing_shift_m", "push until all touch [mm]", MmFromM(1.0), 2},
       [](const DelayedTrial& trial) { return trial.closing.shift; }},
      {{"closing_turn_rad", "turn until all touch [deg]", DegFromRad(1.0), 2},
       [](const DelayedTrial& trial) { return trial.closing.turn; }}};
  for (const GraspResponse& response : ListGraspResponses()) {
    responses.push_back({response.shown, [value = response.value](const DelayedTrial& trial) {
                           return value(trial.record);
                         }});
  }
  return responses;
}

/** One trial at every delay; null where it is not there. */
using Course = std::vector<const DelayedTrial*>;
/** By object, then by grasp and the trial's number. */
using ObjectCourses = std::map<std::string, std::map<std::pair<std::string, int>, Course>>;

struct Block {
  std::string condition, digit, hand;
  ObjectCourses objects;
};

std::vector<Block> GroupBlocks(const std::vector<DelayedTrial>& trials) {
  const std::vector<double>& delays = ListDelays();
  std::vector<Block> blocks;
  for (const DelayedTrial& trial : trials) {
    const PlannedTrial& plan = trial.record.plan;
    const auto key = std::tie(trial.condition, trial.digit, plan.hand);
    auto block = std::find_if(blocks.begin(), blocks.end(), [&key](const Block& candidate) {
      return key == std::tie(candidate.condition, candidate.digit, candidate.hand);
    });
    if (block == blocks.end()) {
      block = blocks.insert(blocks.end(), {trial.condition, trial.digit, plan.hand, {}});
    }
    const auto delay = std::find(delays.begin(), delays.end(), trial.delay);
    GRASPBENCH_DEMAND(delay != delays.end(), std::to_string(trial.delay));
    Course& course = block->objects[plan.object][{plan.grasp, plan.trial}];
    course.resize(delays.size(), nullptr);
    course[static_cast<size_t>(delay - delays.begin())] = &trial;
  }
  return blocks;
}

/** Of the least squares line through the values. */
double CalcSlope(const std::vector<double>& values) {
  const std::vector<double>& delays = ListDelays();
  const double centre = CalcMean(delays);
  double products = 0.0, squares = 0.0;
  for (size_t i = 0; i < delays.size(); ++i) {
    products += (delays[i] - centre) * values[i];
    squares += (delays[i] - centre) * (delays[i] - centre);
  }
  return products / squares;
}

/** Empty when the response is missing at some delay. */
std::vector<double> TakeValues(const Course& course, const DelayResponse& response) {
  std::vector<double> values;
  for (const DelayedTrial* trial : course) {
    const double value = trial ? response.value(*trial) : kUnset;
    if (!std::isfinite(value)) return {};
    values.push_back(value);
  }
  return values;
}

DoseResponse CalcDoseResponse(const Block& block, const DelayResponse& response) {
  DoseResponse row;
  row.condition = block.condition;
  row.digit = block.digit;
  row.hand = block.hand;
  row.response = response.shown;
  row.means.assign(ListDelays().size(), 0.0);
  ObjectChanges slopes;
  for (const auto& [object, courses] : block.objects) {
    for (const auto& [number, course] : courses) {
      const std::vector<double> values = TakeValues(course, response);
      row.num_left_out += values.empty();
      if (values.empty()) continue;
      for (size_t i = 0; i < values.size(); ++i) row.means[i] += values[i];
      slopes[object].push_back(kDelayDose * CalcSlope(values));
    }
  }
  const ChangeEstimate change = EstimateChange(slopes);
  row.num_trials = change.num_draws;
  row.num_objects = change.num_objects;
  row.change = change.estimate;
  row.interval = change.interval;
  for (double& mean : row.means) mean /= row.num_trials;
  return row;
}

}  // namespace

const std::vector<double>& ListDelays() {
  static const std::vector<double> delays = {0.0, 0.05, 0.1, 0.2, 0.3};
  return delays;
}

std::vector<DoseResponse> SummariseDelays(const std::vector<DelayedTrial>& trials) {
  const std::vector<DelayResponse> responses = ListDelayResponses();
  std::vector<DoseResponse> rows;
  for (const Block& block : GroupBlocks(trials)) {
    for (const DelayResponse& response : responses) {
      DoseResponse row = CalcDoseResponse(block, response);
      if (row.num_trials > 0) rows.push_back(std::move(row));
    }
  }
  return rows;
}

namespace {

std::vector<CsvColumn<DoseResponse>> ListDoseColumns() {
  using Row = DoseResponse;
  using C = CsvColumn<Row>;
  std::string delays;
  for (const double delay : ListDelays()) {
    delays += (delays.empty() ? "" : ", ") + FormatFixed(MsFromS(delay), 0);
  }
  const auto means = [](const Row& row) {
    std::string text;
    for (const double mean : row.means) {
      text += (text.empty() ? "" : " ") +
              FormatFixed(row.response.scale * mean, std::min(row.response.decimals, 2));
    }
    return text;
  };
  const auto change = [](const Row& row) {
    const Interval range = row.interval ? *row.interval : Interval{kUnset, kUnset};
    const double scale = row.response.scale;
    return FormatWithRange(scale * row.change, scale * range.low, scale * range.high,
                           std::max(row.response.decimals, 1));
  };
  return {
      C("condition", "", "", &Row::condition).Shown("object"),
      C("late_digit", "", "", &Row::digit).Shown("late digit"),
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("response", "", "",
        [](const Row& row) {
          return row.response.id;
        }).Shown("of the trial", [](const Row& row) { return row.response.label; }),
      C("trials", "", "", &Row::num_trials)
          .Shown("trials",
                 [](const Row& row) {
                   return FormatCountOf(row.num_trials, row.num_trials + row.num_left_out);
                 }),
      {"left_out", "", "", &Row::num_left_out},
      C("objects", "", "", &Row::num_objects).Shown("objects"),
      {"delays_s", "string", "", "", [](const Row&) { return Json(ListDelays()); }},
      C("means", "string", "", "",
        [](const Row& row) {
          return Json(row.means);
        }).Shown("means at " + delays + " ms", means),
      C("change_for_100_ms", "", "", &Row::change).Shown("change for 100 ms", change),
      {"low", "", "", [](const Row& row) { return row.interval ? row.interval->low : kUnset; }},
      {"high", "", "", [](const Row& row) { return row.interval ? row.interval->high : kUnset; }}};
}

}  // namespace

ShownTable ShowDoses(const std::vector<DoseResponse>& rows) {
  return ShowTable(ListDoseColumns(), rows);
}

Json MakeDosesJson(const std::vector<DoseResponse>& rows) {
  Json list = MakeJsonRows(ListDoseColumns(), rows);
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].interval) list[i]["no_interval"] = rows[i].interval.reason();
  }
  return list;
}

}  // namespace graspbench
