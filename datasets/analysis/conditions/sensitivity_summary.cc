#include "datasets/analysis/conditions/sensitivity_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/summary.h"
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

TrialMeasures MakeTrialMeasures(const TrialResult& result) {
  TrialMeasures measures;
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

/** The ids of the session's trials by their draws. @param is_any_grasp  of whatever grasp: only
draws that one grasp has met. */
std::map<std::string, std::string> ListDrawIds(const Session& session, bool is_any_grasp) {
  std::map<std::string, std::string> ids;
  std::set<std::string> repeated;
  for (const PlannedTrial& planned : session.plan) {
    const std::string name = NameDraw(planned, is_any_grasp);
    if (!ids.emplace(name, planned.id).second) repeated.insert(name);
  }
  for (const std::string& name : repeated) ids.erase(name);
  return ids;
}

void AddConditions(const Session& session, const Session& varied, SensitivityData& data,
                   Diagnostics& conflicts) {
  const std::map<std::string, std::string> ids[] = {ListDrawIds(session, false),
                                                    ListDrawIds(session, true)};
  std::map<std::string, std::string> settings;
  for (const Condition& condition : varied.config.conditions) {
    const std::string& setting = condition.settings.at(0);
    settings.emplace(condition.name, setting);
    for (const PlannedTrial& planned : session.plan) {
      if (planned.trial < varied.config.trials) data[setting][planned.id];
    }
  }
  for (const TrialRecord& record : varied.records) {
    if (!record.plan.condition) continue;
    const std::string& setting = settings.at(*record.plan.condition);
    const bool is_any_grasp = setting.rfind("grasp=", 0) == 0;
    const auto id = ids[is_any_grasp].find(NameDraw(record.plan, is_any_grasp));
    if (id == ids[is_any_grasp].end()) continue;
    const TrialMeasures measures = MakeTrialMeasures(record.result);
    TrialMeasures& known = data[setting][id->second];
    if (known.outcome == Outcome::kNotRun) known = measures;
    if (RecordToJson(known) == RecordToJson(measures)) continue;
    conflicts.Fail(
        varied.folder.filename().string(), 0,
        "trial " + id->second + " has two different results under " + *record.plan.condition);
  }
}

}  // namespace

SensitivityData LoadSensitivity(const Session& session) {
  SensitivityData data;
  Diagnostics conflicts;
  for (const Session& varied : LoadExperiments(session, kSensitivityFolder)) {
    AddConditions(session, varied, data, conflicts);
  }
  conflicts.ThrowIfErrors(ErrorKind::kFormat,
                          "two versions of the program have run the session's sensitivity or a "
                          "file was edited; move the folder \"sensitivity\" elsewhere and run "
                          "graspbench sensitivity again");
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

namespace {

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
    return show(heading, "change of the median",
                [=](const Row& row) { return FormatChange(row, id, scale, decimals); });
  };
  return {
      show("setting", "", [](const Row& row) { return FormatSetting(row.setting); }),
      show("was", "the session's value", [](const Row& row) { return FormatSetting(row.value); }),
      show("hand", "", [](const Row& row) { return row.hand; }),
      show("pairs", "trials of the same draws", CountPairs),
      show("won", "failures that succeed after the change",
           [](const Row& row) { return std::to_string(row.successes.second_only); }),
      show("lost", "successes that fail after the change",
           [](const Row& row) { return std::to_string(row.successes.first_only); }),
      show("success [%]", "change of the rate",
           [](const Row& row) {
             return FormatWithRange(100.0 * row.rate_change(), 100.0 * row.rate_change_low,
                                    100.0 * row.rate_change_high, 1);
           }),
      measure("GCT [ms]", "gct_s", MsFromS(1.0), 0),
      measure("GFT [ms]", "gft_s", MsFromS(1.0), 0),
      measure("GFT% [%]", "gft_ratio", 100.0, 1),
      measure("GOT% [%]", "got_ratio", 100.0, 1),
      measure("sigma [N]", "sigma_n", 1.0, 2),
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
