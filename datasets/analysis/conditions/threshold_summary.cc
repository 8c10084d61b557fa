#include "datasets/analysis/conditions/threshold_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "datasets/plan/grip_check.h"
#include "datasets/session/find_trial.h"

namespace graspbench {
double CalcGripAt(const ThresholdScale& scale, int place) {
  GRASPBENCH_DEMAND(place >= 0 && place <= kMostGripPlace, std::to_string(place));
  return scale.least * std::pow(scale.most / scale.least, place / double{kMostGripPlace});
}

namespace {

/** One bisection; once an answer is not known it asks nothing more. */
class Bisection {
 public:
  Bisection(const std::function<std::optional<bool>(int place)>& succeeds, int most)
      : succeeds_(succeeds), most_(most) {}

  GripThreshold Find() {
    if (Holds(most_)) {
      upper_ = most_;
    } else {
      FindWeakerGrip();
    }
    if (upper_ < 0) return found_;
    while (upper_ - lower_ > 1 && CountAsked() < kMostThresholdTrials - 1) {
      Ask((lower_ + upper_) / 2);
    }
    if (!is_lower_asked_ && (upper_ == 0 || Holds(0))) {
      upper_ = 0;
      found_.is_below_range = true;
    } else if (is_lower_asked_ && found_.is_monotone) {
      const int above = (upper_ + most_) / 2;
      if (above > upper_ && above < most_) found_.is_monotone = Holds(above);
    } else if (upper_ - lower_ > 1 && CountAsked() < kMostThresholdTrials) {
      Ask((lower_ + upper_) / 2);
    }
    found_.place = upper_;
    return found_;
  }

 private:
  int CountAsked() const {
    return static_cast<int>(found_.failed.size() + found_.succeeded.size()) +
           (found_.next ? kMostThresholdTrials : 0);
  }

  bool Holds(int place) {
    if (found_.next) return false;
    const std::optional<bool> answer = succeeds_(place);
    if (!answer) {
      found_.next = place;
      return false;
    }
    (*answer ? found_.succeeded : found_.failed).push_back(place);
    return *answer;
  }

  void Ask(int place) {
    if (Holds(place)) {
      upper_ = place;
    } else {
      lower_ = place;
      is_lower_asked_ = true;
    }
  }

  void FindWeakerGrip() {
    for (const int place : {8, 4, 2, 12}) {
      if (place >= most_ || !Holds(place)) continue;
      found_.is_monotone = false;
      upper_ = place;
      is_lower_asked_ = place == 12;
      lower_ = is_lower_asked_ ? 8 : 0;
      return;
    }
  }

  const std::function<std::optional<bool>(int place)>& succeeds_;
  const int most_;
  GripThreshold found_;
  int lower_ = 0, upper_ = -1;  // places; the threshold is above the one, at most the other
  bool is_lower_asked_ = false;
};

}  // namespace

GripThreshold FindGripThreshold(const std::function<std::optional<bool>(int place)>& succeeds,
                                int most) {
  GRASPBENCH_DEMAND(most >= 0 && most <= kMostGripPlace, std::to_string(most));
  GripThreshold found = Bisection(succeeds, most).Find();
  if (found.next) found.place = std::nullopt;
  return found;
}

std::vector<std::string> ListThresholdWarnings(const ThresholdScale& scale, SessionConfig config,
                                               const SessionInputs& inputs) {
  if (scale.mode != GripMode::kForce) return {};
  config.strategy.grip = RowOf(kGripModes, scale.mode).name;
  config.strategy.grip_force = scale.most;
  return ListGripWarnings(config, inputs);
}

namespace {

constexpr int kNumGrips = kMostGripPlace + 1;

/** What a sweep must leave alone. */
constexpr const char* kGripKeys[] = {
    "strategy.grip=", "strategy.grip_force_n=", "strategy.grip_margin="};

/** A draw under the base, 0, or under the k-th condition of a sweep. */
using DrawOf = std::pair<std::string, int>;

/** What is known of every draw of an experiment. */
class KnownGrips {
 public:
  explicit KnownGrips(const Session& experiment) {
    for (size_t i = 0; i < experiment.config.conditions.size(); ++i) {
      numbers_[experiment.config.conditions[i].name] = static_cast<int>(i);
    }
    for (const PlannedTrial& planned : experiment.plan) {
      if (!planned.condition) continue;
      int& most = most_places_.emplace(FindDraw(planned), 0).first->second;
      most = std::max(most, FindPlace(planned));
    }
    for (const TrialRecord& record : experiment.records) {
      if (!record.plan.condition) continue;
      held_[{FindDraw(record.plan), FindPlace(record.plan)}] = IsSuccess(record.result.outcome);
    }
  }

  /** @pre planned.condition is set */
  DrawOf FindDraw(const PlannedTrial& planned) const {
    return {NameDraw(planned), numbers_.at(*planned.condition) / kNumGrips};
  }
  int FindPlace(const PlannedTrial& planned) const {
    return numbers_.at(*planned.condition) % kNumGrips;
  }
  bool IsPlanned(const DrawOf& draw) const { return most_places_.count(draw) > 0; }
  int FindMostPlace(const DrawOf& draw) const { return most_places_.at(draw); }

  GripThreshold Find(const DrawOf& draw) const {
    return FindGripThreshold(
        [&](int place) -> std::optional<bool> {
          const auto known = held_.find({draw, place});
          if (known == held_.end()) return std::nullopt;
          return known->second;
        },
        most_places_.at(draw));
  }

 private:
  std::map<std::string, int> numbers_;  // of a condition
  std::map<DrawOf, int> most_places_;   // of the draws that are planned
  std::map<std::pair<DrawOf, int>, bool> held_;
};

/** The largest k with P(B < k) <= 2.5 % for B of n draws with 1/2; 0: there is none. */
int CalcOrderRank(int n) {
  double probability = std::pow(0.5, n), below = 0.0;
  int k = 0;
  while (k < n && below + probability <= 0.025) {
    below += probability;
    probability *= static_cast<double>(n - k) / (k + 1);
    ++k;
  }
  return k;
}

CellThreshold SummariseCell(const std::vector<const DrawThreshold*>& draws) {
  const PlannedTrial& first = draws.front()->draw;
  CellThreshold cell = {
      first.condition.value_or(""), first.hand, first.object, first.grasp, 0, 0, 0, {}};
  std::vector<double> values;
  for (const DrawThreshold* draw : draws) {
    if (std::isnan(draw->value)) continue;
    values.push_back(draw->value);
    if (std::isinf(draw->value)) ++cell.num_never;
    if (draw->found.is_below_range) ++cell.num_below;
    if (!draw->found.is_monotone) cell.not_monotone.push_back(draw->draw.trial);
  }
  cell.num_draws = static_cast<int>(values.size());
  if (values.empty()) return cell;
  cell.median = CalcMedian(values);
  if (const auto interval = CalcMedianInterval(values)) {
    cell.low = interval->low;
    cell.high = interval->high;
  }
  return cell;
}

/** @throws Error(kUsage) for a condition that sets what is bisected. */
void CheckLeavesGrip(const Condition& condition) {
  for (const std::string& setting : condition.settings) {
    for (const std::string key : kGripKeys) {
      if (setting.rfind(key, 0) != 0) continue;
      throw Error(ErrorKind::kUsage,
                  "a threshold search varies the grip, but the sweep has the factor \"" +
                      key.substr(0, key.size() - 1) + "\"; leave out the factor or the thresholds");
    }
  }
}

/** JSON and tables know no infinity. */
Json JsonThreshold(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

std::vector<Condition> ListThresholdGrips(const ThresholdScale& scale,
                                          const SessionConfig& config) {
  std::vector<std::string> common = {std::string("strategy.grip=") +
                                     RowOf(kGripModes, scale.mode).name};
  // None of the grips may be the session's own trial: the key that its scale does not look at, or
  // hardly, has another value than there.
  const StrategyConfig& base = config.strategy;
  common.push_back(scale.mode == GripMode::kMargin
                       ? "strategy.grip_force_n=" + FormatJson(base.grip_force > 0.0 ? 0.0 : 1e-3)
                       : "strategy.grip_margin=" + FormatJson(base.grip_margin > 1.0 ? 1.0 : 2.0));
  if (config.strategy.grip == RowOf(kGripModes, GripMode::kPosture).name) {
    common.push_back("strategy.touch_speed=" + FormatJson(MakePeopleGrip().touch_speed));
  }
  std::vector<Condition> under = {{"", {}}};
  under.insert(under.end(), config.conditions.begin(), config.conditions.end());
  std::vector<Condition> grips;
  for (const Condition& condition : under) {
    CheckLeavesGrip(condition);
    for (int place = 0; place <= kMostGripPlace; ++place) {
      const double grip = CalcGripAt(scale, place);
      const std::string name = scale.name + (" " + FormatFixed(grip, 3));
      grips.push_back({condition.name.empty() ? name : condition.name + ", " + name, common});
      std::vector<std::string>& settings = grips.back().settings;
      settings.insert(settings.end(), condition.settings.begin(), condition.settings.end());
      settings.push_back(scale.key + ("=" + FormatJson(grip)));
    }
  }
  return grips;
}

int ThresholdSummary::num_not_monotone() const {
  int number = 0;
  for (const CellThreshold& cell : cells) number += static_cast<int>(cell.not_monotone.size());
  return number;
}

ThresholdSummary SummariseThresholds(const Session& experiment, const Session& session) {
  ThresholdSummary summary;
  summary.scale = FindThresholdScale(experiment.config);
  if (!summary.scale) {
    throw Error(ErrorKind::kFormat,
                "the conditions of an experiment below thresholds/ are no grips of a scale; move "
                "its folder elsewhere and run graspbench threshold again");
  }
  std::map<std::string, int> numbers;  // of the session's conditions
  for (const Condition& condition : session.config.conditions) {
    numbers.emplace(condition.name, static_cast<int>(numbers.size()) + 1);
  }
  const KnownGrips known(experiment);
  for (const PlannedTrial& planned : session.plan) {
    const DrawOf name = {NameDraw(planned), planned.condition ? numbers.at(*planned.condition) : 0};
    if (!known.IsPlanned(name)) continue;
    DrawThreshold draw = {planned, known.FindMostPlace(name), known.Find(name)};
    if (!draw.found.next) {
      draw.value = draw.found.place ? CalcGripAt(*summary.scale, *draw.found.place) : HUGE_VAL;
    }
    summary.num_trials += static_cast<int>(draw.found.failed.size() + draw.found.succeeded.size());
    summary.draws.push_back(std::move(draw));
  }
  std::vector<std::string> order;
  std::map<std::string, std::vector<const DrawThreshold*>> cells;
  for (const DrawThreshold& draw : summary.draws) {
    const std::string key = draw.draw.condition.value_or("") + "\n" + draw.draw.hand + " " +
                            draw.draw.object + " " + draw.draw.grasp;
    if (cells[key].empty()) order.push_back(key);
    cells[key].push_back(&draw);
  }
  for (const std::string& key : order) summary.cells.push_back(SummariseCell(cells[key]));
  return summary;
}

std::vector<ThresholdSummary> LoadThresholds(const Session& session) {
  std::map<const ThresholdScale*, ThresholdSummary> found;
  const auto count = [](const ThresholdSummary& summary) {
    return std::count_if(summary.draws.begin(), summary.draws.end(),
                         [](const DrawThreshold& draw) { return !std::isnan(draw.value); });
  };
  for (const Session& experiment : LoadExperiments(session, "thresholds")) {
    ThresholdSummary one = SummariseThresholds(experiment, session);
    ThresholdSummary& known = found[one.scale];
    if (!known.scale || count(one) > count(known)) known = std::move(one);
  }
  std::vector<ThresholdSummary> all;
  for (const ThresholdScale& scale : kThresholdScales) {
    if (const auto one = found.find(&scale); one != found.end()) all.push_back(one->second);
  }
  return all;
}

std::string NameNotMonotone(const CellThreshold& cell) {
  if (cell.not_monotone.empty()) return "none";
  std::string text;
  for (const int number : cell.not_monotone) {
    text += (text.empty() ? "" : ", ") + std::to_string(number);
  }
  return (cell.not_monotone.size() == 1 ? "draw " : "draws ") + text;
}

std::string DescribeCeilings(const ThresholdSummary& summary) {
  std::map<std::string, int> most_places;
  for (const DrawThreshold& draw : summary.draws) {
    if (draw.most_place == kMostGripPlace) continue;
    most_places[draw.draw.hand + " " + draw.draw.grasp] = draw.most_place;
  }
  std::string text;
  for (const auto& [of, place] : most_places) {
    text += (text.empty() ? "no " : "; no ") + std::string(summary.scale->name) + " above " +
            FormatThreshold(*summary.scale, CalcGripAt(*summary.scale, place)) + " is asked of " +
            of + ", the limit of its drives";
  }
  return text;
}

std::string FormatMedian(const ThresholdScale& scale, const CellThreshold& cell) {
  return (cell.is_at_most() ? "at most " : "") + FormatThreshold(scale, cell.median);
}

std::vector<double> ListThresholdsOf(const Session& session, const ThresholdSummary& summary) {
  std::map<std::string, double> known;
  for (const DrawThreshold& draw : summary.draws) known[draw.draw.id] = draw.value;
  std::vector<double> values;
  for (const TrialRecord& record : session.records) {
    const auto value = known.find(record.plan.id);
    values.push_back(value == known.end() ? kUnset : value->second);
  }
  return values;
}

std::vector<PlannedTrial> FindThresholdTrials(const Session& experiment) {
  const KnownGrips known(experiment);
  std::map<DrawOf, std::optional<int>> next;
  std::vector<PlannedTrial> trials;
  for (const PlannedTrial& planned : experiment.plan) {
    if (!planned.condition) continue;
    const DrawOf draw = known.FindDraw(planned);
    const auto [asked, is_new] = next.emplace(draw, std::nullopt);
    if (is_new) asked->second = known.Find(draw).next;
    if (asked->second == known.FindPlace(planned)) trials.push_back(planned);
  }
  return trials;
}

std::optional<Interval> CalcMedianInterval(std::vector<double> values) {
  const int rank = CalcOrderRank(static_cast<int>(values.size()));
  if (rank == 0) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Interval{values[static_cast<size_t>(rank - 1)],
                  values[values.size() - static_cast<size_t>(rank)]};
}

std::string FormatThreshold(const ThresholdScale& scale, double value) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return "none held";
  return FormatFixed(value, 2) + (*scale.unit ? std::string(" ") + scale.unit : "");
}

std::vector<ExportTable> MakeThresholdTables(const std::vector<ThresholdSummary>& thresholds) {
  if (thresholds.empty()) return {};
  struct Row {
    const ThresholdScale* scale;
    const DrawThreshold* draw;
  };
  std::vector<Row> rows;
  for (const ThresholdSummary& summary : thresholds) {
    for (const DrawThreshold& draw : summary.draws) {
      if (!std::isnan(draw.value)) rows.push_back({summary.scale, &draw});
    }
  }
  const std::vector<CsvColumn<Row>> columns = {
      {"trial_id", "", "of the session's trial with the same draw",
       [](const Row& row) { return row.draw->draw.id; }},
      {"condition", "", "of a sweep; empty: the base",
       [](const Row& row) { return row.draw->draw.condition.value_or(""); }},
      {"hand", "", "id of the hand", [](const Row& row) { return row.draw->draw.hand; }},
      {"object", "", "id of the object", [](const Row& row) { return row.draw->draw.object; }},
      {"grasp", "", "id of the grasp", [](const Row& row) { return row.draw->draw.grasp; }},
      {"trial", "", "number of the trial within its hand, object and grasp, from 0",
       [](const Row& row) { return row.draw->draw.trial; }},
      {"threshold_scale", "", "margin, or force [N]",
       [](const Row& row) { return row.scale->name; }},
      {"grip_threshold", "number", "",
       "smallest grip with which the draw succeeds; empty: no grip that was asked held",
       [](const Row& row) { return JsonThreshold(row.draw->value); }},
      {"threshold_is_least", "",
       "1 if the smallest grip of the scale succeeded: the threshold is at or below it",
       [](const Row& row) { return row.draw->found.is_below_range; }},
      {"threshold_is_monotone", "", "0 if a larger grip failed although a smaller one succeeded",
       [](const Row& row) { return row.draw->found.is_monotone; }},
      {"threshold_trials", "", "number of trials of the bisection", [](const Row& row) {
         return row.draw->found.failed.size() + row.draw->found.succeeded.size();
       }}};
  return {{"thresholds", FormatCsv(columns, rows), MakeTableSchema(columns, "")}};
}

namespace {

std::vector<CsvColumn<CellThreshold>> ListCellColumns(const ThresholdSummary& summary) {
  using Row = CellThreshold;
  using C = CsvColumn<Row>;
  const ThresholdScale& scale = *summary.scale;
  const bool is_sweep = std::any_of(summary.cells.begin(), summary.cells.end(),
                                    [](const Row& row) { return !row.condition.empty(); });
  const auto interval = [&scale](const Row& row) {
    return std::isnan(row.low)
               ? "n/a"
               : FormatThreshold(scale, row.low) + " to " + FormatThreshold(scale, row.high);
  };
  const auto threshold = [](double Row::*member) {
    return [member](const Row& row) { return JsonThreshold(row.*member); };
  };
  return {C("condition", "", "", &Row::condition)
              .Shown(is_sweep ? "condition" : "",
                     [](const Row& row) { return row.condition.empty() ? "base" : row.condition; }),
          C("hand", "", "", &Row::hand).Shown("hand"),
          C("object", "", "", &Row::object).Shown("object"),
          C("grasp", "", "", &Row::grasp).Shown("grasp"),
          C("draws", "", "", &Row::num_draws).Shown("draws"),
          C::ForPeople("grip threshold", "median over draws of the smallest grip with success",
                       [&scale](const Row& row) { return FormatMedian(scale, row); }),
          C::ForPeople("95 % interval", "of order statistics", interval),
          C("never_held", "", "by no grip that was asked", &Row::num_never).Shown("never held"),
          C("held_by_least", "", "the threshold is no larger than the scale's end", &Row::num_below)
              .Shown("held by the least"),
          C("not_monotone", "string", "",
            "draws that fail again with a larger grip, within the tested range",
            [](const Row& row) {
              return Json(row.not_monotone);
            }).Shown("not monotone", NameNotMonotone),
          {"median", "number", "", "", threshold(&Row::median)},
          {"low", "number", "", "", threshold(&Row::low)},
          {"high", "number", "", "", threshold(&Row::high)}};
}

}  // namespace

ShownTable ShowCells(const ThresholdSummary& summary) {
  return ShowTable(ListCellColumns(summary), summary.cells);
}

Json ToJson(const ThresholdSummary& summary) {
  return {{"scale", summary.scale->name},
          {"unit", summary.scale->unit},
          {"cells", MakeJsonRows(ListCellColumns(summary), summary.cells)},
          {"draws", summary.draws.size()},
          {"trials", summary.num_trials},
          {"not_monotone", summary.num_not_monotone()}};
}

}  // namespace graspbench
