#include "datasets/analysis/conditions/sensitivity_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/pairs.h"
#include "datasets/journal/read_journal.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/session_plan.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/judgement_store.h"

namespace graspbench {
namespace {

/** A number and what it is multiplied by. */
struct Factors {
  const char* key;
  std::vector<double> factors;
};
const std::vector<Factors> kFactors = {
    {"variation.offset_m", {0.0, 2.0}},
    {"variation.yaw_rad", {0.0, 2.0}},
    {"model.joint_error_scale", {0.0, 2.0}},
    {"model.pad_torsion_scale", {0.5, 2.0}},
    {"model.pad_stiffness_scale", {0.5, 2.0}},
    {"model.friction_scale", {0.8, 1.25}},
    {"model.mass_scale", {0.5, 2.0}},
    {"model.drive_torque_scale", {0.5, 2.0}},
    {"sim.contact_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.tangential_stiffness_n_per_m", {0.5, 2.0}},
    {"sim.arm_stiffness_n_per_m", {0.5, 2.0}},
};

std::vector<std::string> ListDefaultVariations(const SessionConfig& config) {
  std::vector<std::string> settings;
  const auto add = [&](const std::string& assignment) {
    SessionConfig changed = config;
    ApplySetting(assignment, changed);
    if (FindConfigDifferences(config, changed).empty() || !Validate(changed).empty()) return;
    settings.push_back(NormaliseSetting(assignment, config));
  };
  const Json json = ToJson(config);
  for (const Factors& row : kFactors) {
    const std::string key = row.key;
    const size_t dot = key.find('.');
    const double value = json.at(key.substr(0, dot)).at(key.substr(dot + 1)).get<double>();
    for (const double factor : row.factors) add(key + "=" + FormatJson(factor * value));
  }
  for (const std::string& rule : ListModelCouplings()) add("model.coupling_rule=" + rule);
  return settings;
}

}  // namespace

std::vector<Condition> ListSensitivityConditions(const SessionConfig& config,
                                                 const std::vector<std::string>& settings) {
  std::vector<std::string> tried;
  for (const std::string& assignment : settings) {
    const std::string setting = NormaliseSetting(assignment, config);
    if (std::find(tried.begin(), tried.end(), setting) != tried.end()) {
      throw Error(ErrorKind::kUsage, "\"" + setting + "\" is named twice; leave one out");
    }
    RefuseUnusedGrip(setting, config.strategy);
    tried.push_back(setting);
  }
  std::vector<Condition> conditions;
  for (const std::string& setting : settings.empty() ? ListDefaultVariations(config) : tried) {
    conditions.push_back({setting, {setting}});
  }
  return conditions;
}

namespace {

constexpr char kSensitivityFolder[] = "sensitivity";

}  // namespace

TrialMeasures MakeTrialMeasures(const TrialRecord& record) {
  const TrialResult& result = record.result;
  TrialMeasures measures;
  measures.grasp = FindUsedGrasp(record);
  measures.outcome = result.outcome;
  if (IsNumericalFailure(result.outcome)) return measures;
  if (!result.timing.contact_before_start) {
    measures.gct = result.timing.gct;
    measures.gft = result.timing.gft;
    measures.gft_ratio = result.timing.gft_ratio;
    measures.got_ratio = result.timing.got_ratio;
  }
  measures.sigma = result.stability.sigma;
  return measures;
}

namespace {

/** "model.mass_scale=0.5", and whether best grasps were chosen again. */
std::string NameSetting(const Condition& condition) {
  return condition.settings.at(0) +
         (ChoosesGraspAgain(condition) ? ", best grasps chosen again" : "");
}

void AddConditions(const Session& session, const Session& varied, SensitivityData& data,
                   Diagnostics& conflicts) {
  for (const Condition& condition : varied.config.conditions) {
    VariedTrials& trials = data[NameSetting(condition)];
    for (const PlannedTrial& planned : session.plan) {
      if (planned.trial < varied.config.trials) trials[planned.id];
    }
    for (const ComparedDraw& draw : ListComparedDraws({{&session}, {&varied, condition.name}})) {
      if (!draw.planned[0] || !draw.records[1]) continue;
      const TrialMeasures measures = MakeTrialMeasures(*draw.records[1]);
      TrialMeasures& known = trials[draw.planned[0]->id];
      if (known.outcome == Outcome::kNotRun) known = measures;
      if (RecordToJson(known) == RecordToJson(measures)) continue;
      conflicts.Fail(
          varied.folder.filename().string(), 0,
          "trial " + draw.planned[0]->id + " has two different results under " + condition.name);
    }
  }
}

}  // namespace

SensitivityData LoadSensitivity(const Session& session) {
  SensitivityData data;
  Diagnostics conflicts;
  for (const Session& varied : LoadExperiments(session, kSensitivityFolder)) {
    AddConditions(session, varied, data, conflicts);
  }
  conflicts.ThrowIfErrors(
      ErrorKind::kFormat,
      "two versions of the program have written these results, or a file was edited; move the "
      "folder \"sensitivity\" away and run graspbench sensitivity again");
  return data;
}

namespace {

constexpr int kNumClasses = 4;
constexpr char kPositioning[] = "positioning=";

/** The positionings, each with the outcome of a trial under it. */
struct PositionedTrials {
  std::string name;
  const VariedTrials* trials = nullptr;  // null: the session's own
};

std::vector<PositionedTrials> ListPositionedTrials(const Session& session,
                                                   const SensitivityData& varied) {
  std::vector<PositionedTrials> all = {{session.config.positioning, nullptr}};
  for (const auto& [setting, trials] : varied) {
    if (setting.rfind(kPositioning, 0) != 0) continue;
    all.push_back({setting.substr(sizeof kPositioning - 1), &trials});
  }
  return all;
}

int FindClass(const SessionConfig& config, const PlannedTrial& plan, double width) {
  const TrialDraw draw = MakeObjectDraw(config, plan.object, plan.trial);
  const double offset = std::hypot(draw.offset_x, draw.offset_y);
  return std::min(static_cast<int>(offset / width), kNumClasses - 1);
}

}  // namespace

std::vector<OffsetClass> ListOffsetClasses(const Session& session, const SensitivityData& varied) {
  const double width = std::sqrt(2.0) * session.config.variation.offset / kNumClasses;
  std::vector<OffsetClass> classes;
  if (!(width > 0.0)) return classes;
  const std::vector<PositionedTrials> positionings = ListPositionedTrials(session, varied);
  for (const TrialRecord& record : session.records) {
    const std::string& hand = record.plan.hand;
    auto first = std::find_if(classes.begin(), classes.end(),
                              [&](const OffsetClass& c) { return c.hand == hand; });
    if (first == classes.end()) {
      const auto place = classes.size();
      for (const PositionedTrials& positioning : positionings) {
        for (int i = 0; i < kNumClasses; ++i) {
          classes.push_back({hand, positioning.name, width * i, width * (i + 1), Tally()});
        }
      }
      first = classes.begin() + static_cast<std::ptrdiff_t>(place);
    }
    auto found = first + FindClass(session.config, record.plan, width);
    for (const PositionedTrials& positioning : positionings) {
      if (!positioning.trials) {
        found->tally.Count(record.result.outcome);
      } else if (const auto trial = positioning.trials->find(record.plan.id);
                 trial != positioning.trials->end() && trial->second.outcome != Outcome::kNotRun) {
        found->tally.Count(trial->second.outcome);
      }
      found += kNumClasses;
    }
  }
  return classes;
}

namespace {

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
  std::string object;
  TrialMeasures before, after;
};

/** The pairs of one hand, and what has none. */
struct HandPairs {
  std::string hand;
  std::vector<Pair> pairs;
  OutcomeCounts left_out;
  int num_unfinished = 0, num_without_pair = 0, num_other_grasp = 0;
};

MeasureChange CompareMeasure(const std::vector<Pair>& pairs, const Measure& measure) {
  ObjectChanges changes;
  std::vector<double> before, after;
  bool is_same = true;
  for (const Pair& pair : pairs) {
    const double x = pair.before.*measure.member, y = pair.after.*measure.member;
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    before.push_back(x);
    after.push_back(y);
    changes[pair.object].push_back(y - x);
    is_same = is_same && x == y;
  }
  const ChangeEstimate estimate = EstimateChange(changes);
  MeasureChange change;
  change.measure = measure.key;
  change.num_pairs = estimate.num_draws;
  if (before.empty()) {
    change.no_interval = "no pair has it twice";
    return change;
  }
  change.before = CalcMean(before);
  change.after = CalcMean(after);
  if (estimate.interval && !is_same) {
    change.low = estimate.interval->low;
    change.high = estimate.interval->high;
  } else {
    change.no_interval = is_same ? "no trial changes" : estimate.interval.reason();
  }
  return change;
}

void Count(Outcome outcome, OutcomeCounts& counts) {
  ++counts.num_finished;
  counts.num_successes += IsSuccess(outcome);
}

SettingChange Compare(const std::string& setting, const HandPairs& hand) {
  SettingChange change;
  change.setting = setting;
  change.hand = hand.hand;
  ObjectChanges changes;
  OutcomeCounts compared;
  for (const Pair& pair : hand.pairs) {
    const bool before = IsSuccess(pair.before.outcome), after = IsSuccess(pair.after.outcome);
    change.successes.Add(before, after);
    changes[pair.object].push_back(double(after) - double(before));
    Count(pair.before.outcome, compared);
    Count(pair.after.outcome, compared);
    change.num_other_grasp += pair.before.grasp != pair.after.grasp;
  }
  const ChangeEstimate estimate =
      EstimateSuccessChange(changes, change.successes, ExplainUndecided(compared, hand.left_out));
  change.num_objects = estimate.num_objects;
  if (estimate.interval) {
    change.rate_change_low = estimate.interval->low;
    change.rate_change_high = estimate.interval->high;
  } else {
    change.no_interval = estimate.interval.reason();
  }
  for (const Measure& measure : kMeasures) {
    change.measures.push_back(CompareMeasure(hand.pairs, measure));
  }
  change.num_left_out = hand.num_unfinished + hand.num_without_pair + hand.num_other_grasp;
  change.why_left_out = DescribeCounts({{hand.num_unfinished, "not finished"},
                                        {hand.num_without_pair, "without a partner"},
                                        {hand.num_other_grasp, "with another grasp"}});
  return change;
}

/** The pairs of each hand that has a trial among them, in the plan's order. */
std::vector<HandPairs> ListPairs(const Session& session, const VariedTrials& trials,
                                 PairsTaken taken) {
  std::map<std::string, const TrialRecord*> finished;
  for (const TrialRecord& record : session.records) finished.emplace(record.plan.id, &record);
  std::vector<HandPairs> hands;
  for (const PlannedTrial& planned : session.plan) {
    const auto varied = trials.find(planned.id);
    if (varied == trials.end()) continue;
    if (hands.empty() || hands.back().hand != planned.hand) {
      hands.emplace_back();
      hands.back().hand = planned.hand;
    }
    const auto record = finished.find(planned.id);
    const bool has_after = varied->second.outcome != Outcome::kNotRun;
    if (record == finished.end()) {
      ++hands.back().num_unfinished;
      if (has_after) Count(varied->second.outcome, hands.back().left_out);
    } else if (!has_after) {
      ++hands.back().num_without_pair;
      Count(record->second->result.outcome, hands.back().left_out);
    } else if (taken == PairsTaken::kSameGrasp &&
               varied->second.grasp != FindUsedGrasp(*record->second)) {
      ++hands.back().num_other_grasp;
      Count(record->second->result.outcome, hands.back().left_out);
      Count(varied->second.outcome, hands.back().left_out);
    } else {
      hands.back().pairs.push_back(
          {planned.object, MakeTrialMeasures(*record->second), varied->second});
    }
  }
  return hands;
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

namespace {

std::string FormatRateChange(const SettingChange& change) {
  const std::string text =
      FormatWithRange(100.0 * change.rate_change(), 100.0 * change.rate_change_low,
                      100.0 * change.rate_change_high, 1);
  return change.no_interval.empty() || change.successes.num_pairs() == 0
             ? text
             : text + ", " + change.no_interval;
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

std::vector<CsvColumn<SettingChange>> ListChangeColumns() {
  using Row = SettingChange;
  const auto show = [](const char* heading, const char* hint, CsvColumn<Row>::Show cell) {
    return CsvColumn<Row>::ForPeople(heading, hint, std::move(cell));
  };
  const auto measure = [&](const char* heading, const char* id, double scale, int decimals) {
    return show(heading, "mean change",
                [=](const Row& row) { return FormatChange(row, id, scale, decimals); });
  };
  return {
      show("setting", "", [](const Row& row) { return FormatSetting(row.setting); }),
      show("of", "which pairs", [](const Row& row) { return row.setting; }),
      show("was", "the session's value", [](const Row& row) { return FormatSetting(row.value); }),
      show("hand", "", [](const Row& row) { return row.hand; }),
      show("pairs", "trials of the same draws", CountPairs),
      show("improved", "failures that succeed after the change",
           [](const Row& row) { return std::to_string(row.successes.second_only); }),
      show("worsened", "successes that fail after the change",
           [](const Row& row) { return std::to_string(row.successes.first_only); }),
      show("objects", "of these pairs",
           [](const Row& row) { return std::to_string(row.num_objects); }),
      show("success [%]", "change of the rate", FormatRateChange),
      measure("GCT [ms]", "gct_s", MsFromS(1.0), 0),
      measure("GFT [ms]", "gft_s", MsFromS(1.0), 0),
      measure("GFT% [%]", "gft_ratio", 100.0, 1),
      measure("GOT% [%]", "got_ratio", 100.0, 1),
      measure("sigma [N]", "sigma_n", 1.0, 2),
      show("other grasp", "pairs whose trials have other grasps",
           [](const Row& row) {
             return row.num_other_grasp == 0 ? "" : FormatCount(row.num_other_grasp, "pair");
           }),
      show("left out", "trials without a pair", [](const Row& row) { return row.why_left_out; })};
}

}  // namespace

ShownTable ShowChanges(const std::vector<SettingChange>& changes,
                       const std::vector<std::string>& headings) {
  return ShowTable(ListChangeColumns(), changes, headings);
}

std::string DescribeChanges(const std::vector<SettingChange>& changes) {
  const auto lacks_values = [](const SettingChange& change) {
    const int num_pairs = change.successes.num_pairs();
    return std::any_of(
        change.measures.begin(), change.measures.end(),
        [num_pairs](const MeasureChange& measure) { return measure.num_pairs < num_pairs; });
  };
  return std::string(
             "mean changes over pairs of the same draw, with 95 % intervals from resampling "
             "objects (success with fewer than 5 objects: these objects only)\n") +
         (std::any_of(changes.begin(), changes.end(), lacks_values)
              ? "n of N pairs: in the other pairs one of the trials does not have this measure\n"
              : "");
}

std::vector<SettingChange> ListChanges(const Session& session, const std::string& setting,
                                       const VariedTrials& trials, PairsTaken taken) {
  std::vector<SettingChange> changes;
  for (const HandPairs& hand : ListPairs(session, trials, taken)) {
    changes.push_back(Compare(setting, hand));
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
