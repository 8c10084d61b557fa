#include "human_study/study/inference/measure_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics/multiple_tests.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

namespace {

/** The trials of each cell, without regard to persons. */
std::vector<Answer<Summary>> SummariseCells(const MeasureTable& table) {
  std::map<std::vector<std::string>, std::vector<double>> values;
  for (const Observation& row : table.rows) values[row.levels].push_back(row.value);
  std::vector<Answer<Summary>> summaries;
  for (const std::vector<std::string>& levels : ListLevels(table.factors)) {
    summaries.push_back(CalcSummary(values[levels]));
  }
  return summaries;
}

/** Interval of the mean of one value a person. */
Answer<BootstrapInterval> CalcMeanInterval(const std::vector<double>& values,
                                           const std::string& id) {
  return CalcBootstrap(
      values.size(),
      [&](const std::vector<size_t>& members) {
        double sum = 0.0;
        for (const size_t member : members) sum += values[member];
        return sum / static_cast<double>(members.size());
      },
      id);
}

std::vector<double> ListMeans(const CellMeans& cells, size_t cell) {
  const auto column = cells.means.col(static_cast<Eigen::Index>(cell));
  return std::vector<double>(column.begin(), column.end());
}

std::vector<PairStatistics> CalcPairs(const CellMeans& cells, const std::string& measure,
                                      const Hypothesis& hypothesis) {
  std::vector<PairStatistics> pairs;
  std::vector<double> p;
  for (const PairComparison& means : ComparePairs(cells)) {
    PairStatistics pair;
    pair.means = means;
    const std::vector<double> a = ListMeans(cells, means.a), b = ListMeans(cells, means.b);
    pair.ranks = CalcWilcoxon(b, a);
    p.push_back(pair.ranks ? pair.ranks->p : std::nan(""));
    std::vector<double> differences;
    for (size_t person = 0; person < a.size(); ++person) {
      differences.push_back(b[person] - a[person]);
    }
    pair.bootstrap = CalcMeanInterval(
        differences, measure + ", " + cells.cells[means.b] + " - " + cells.cells[means.a]);
    if (std::isnan(hypothesis.equal_within)) {
      pair.equivalence = NoAnswer{"no bounds were named"};
    } else {
      pair.equivalence =
          CalcEquivalence(means.test, {-hypothesis.equal_within, hypothesis.equal_within});
    }
    pairs.push_back(pair);
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  for (size_t i = 0; i < pairs.size(); ++i) pairs[i].p_ranks_holm = adjusted[i];
  return pairs;
}

TrendStatistics CalcTrend(const MeasureTable& table, size_t factor, double reference) {
  TrendStatistics trend;
  trend.factor = table.factors[factor].name;
  const Answer<std::vector<PersonPoint>> points = ListPoints(table, factor);
  if (!points) {
    trend.slopes.test = points.none();
    trend.bootstrap = points.none();
    trend.model = points.none();
    return trend;
  }
  trend.slopes = CalcPersonSlopes(*points, reference);
  std::vector<double> slopes;
  for (const PersonLine& person : trend.slopes.persons) {
    if (person.line) slopes.push_back(person.line->slope);
  }
  trend.bootstrap = CalcMeanInterval(slopes, table.measure + " over " + trend.factor);
  trend.model = FitQuantityModel(table, factor, reference);
  return trend;
}

}  // namespace

std::vector<std::vector<std::string>> ListLevels(const std::vector<Factor>& factors) {
  std::vector<std::vector<std::string>> cells = {{}};
  for (const Factor& factor : factors) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& cell : cells) {
      for (const std::string& level : factor.levels) {
        longer.push_back(cell);
        longer.back().push_back(level);
      }
    }
    cells = std::move(longer);
  }
  return cells;
}

Answer<Summary> SummariseRows(const MeasureTable& table) {
  std::vector<double> values;
  for (const Observation& row : table.rows) values.push_back(row.value);
  return CalcSummary(values);
}

Answer<WithinAnova> CalcAnova(const Answer<CellMeans>& cells) {
  if (!cells) return cells.none();
  if (cells->factors.empty() && cells->groups.empty()) {
    return NoAnswer{"the study names no factor"};
  }
  return CalcWithinAnova(*cells);
}

MeasureStatistics CalcMeasureStatistics(const TrialMeasure& measure, const MeasureTable& table,
                                        const Hypothesis& hypothesis) {
  MeasureStatistics statistics;
  statistics.measure = measure;
  statistics.hypothesis = hypothesis;
  statistics.table = table;
  statistics.summary = SummariseRows(table);
  statistics.by_cell = SummariseCells(table);
  statistics.cells = CalcCellMeans(table);
  statistics.anova = CalcAnova(statistics.cells);
  if (statistics.cells) {
    statistics.friedman = CalcFriedman(*statistics.cells);
    statistics.pairs = CalcPairs(*statistics.cells, table.measure, hypothesis);
    statistics.group_pairs = CompareGroups(*statistics.cells);
  } else {
    statistics.friedman = statistics.cells.none();
  }
  statistics.model = FitEffectsModel(table);
  statistics.retest = table.sessions.empty()
                          ? Answer<Retest>(NoAnswer{"the study names no session"})
                          : CalcRetest(table);
  for (size_t factor = 0; factor < table.factors.size(); ++factor) {
    if (table.factors[factor].numbers.empty()) continue;
    statistics.trends.push_back(CalcTrend(table, factor, hypothesis.slope));
  }
  return statistics;
}

namespace {

constexpr BarKind kDrawnBars = BarKind::kLoftusMasson;

void ChooseDrawn(const Answer<CellMeans>& cells, ConditionEstimates& estimates) {
  if (!cells) {
    estimates.drawn = cells.none();
    estimates.drawn_kind = "none, " + cells.reason();
    return;
  }
  estimates.drawn = CalcHalfWidths(*cells, kDrawnBars);
  estimates.drawn_kind = NameOf(kDrawnBars);
  if (estimates.drawn) return;
  estimates.drawn_kind = "none, " + estimates.drawn.reason();
  estimates.drawn = CalcHalfWidths(*cells, BarKind::kBetweenPerson);
  if (estimates.drawn) estimates.drawn_kind = NameOf(BarKind::kBetweenPerson);
}

}  // namespace

Interval FindPossible(const TrialMeasure& measure) {
  return std::string(measure.unit) == "1" ? Interval{0.0, 1.0} : Interval{-INFINITY, INFINITY};
}

Interval FindPossibleDifference(const TrialMeasure& measure) {
  const Interval possible = FindPossible(measure);
  return {possible.low - possible.high, possible.high - possible.low};
}

Interval CutAt(const Interval& possible, const Interval& interval) {
  return {std::max(interval.low, possible.low), std::min(interval.high, possible.high)};
}

ConditionEstimates CalcConditionEstimates(const MeasureStatistics& statistics) {
  ConditionEstimates estimates;
  estimates.possible = FindPossible(statistics.measure);
  estimates.cells = ListCells(statistics.table.factors);
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    const Answer<Summary>& trials = statistics.by_cell[cell];
    const auto column = static_cast<Eigen::Index>(cell);
    estimates.means.push_back(statistics.cells ? statistics.cells->means.col(column).mean()
                              : trials         ? trials->mean
                                               : std::nan(""));
    estimates.num_trials.push_back(trials ? trials->count : 0);
  }
  for (const BarKind kind : ListBarKinds()) {
    estimates.half_widths.push_back(statistics.cells
                                        ? CalcHalfWidths(*statistics.cells, kind)
                                        : Answer<Eigen::VectorXd>(statistics.cells.none()));
  }
  ChooseDrawn(statistics.cells, estimates);
  return estimates;
}

namespace {

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

const std::vector<PublishedValue>& PublishedValueList() {
  static const std::vector<PublishedValue> values = {
      {"relative_reacceleration", false, "",
       "about 75 % of movement time, at every distance of the object",
       "Jeannerod 1984, J. Mot. Behav. 16:235-254"},
      {"reacceleration_to_peak_opening_s", false, "",
       "near 0: the hand begins to close when the low-velocity phase begins",
       "Jeannerod 1984, J. Mot. Behav. 16:235-254"},
      {"peak_opening_m", true, "_m",
       "thumb and index open by 0.82 m more per metre of size (review); 0.70 (SD 0.12) over 11 "
       "people and sticks of 50 to 110 mm",
       "Smeets and Brenner 1999, Motor Control 3:237-271; data of mocapGrip"},
      {"contact_to_lift_s", false, "", "about 200 ms",
       "Johansson and Westling 1984, Exp. Brain Res. 56:550-564"},
      {"contact_to_lift_s", true, "_kg", "above 0: heavier things are loaded for longer",
       "Johansson and Westling 1984, Exp. Brain Res. 56:550-564"},
  };
  return values;
}

std::vector<ComparedValue> ComparePublished(const StudyResult& result) {
  std::vector<ComparedValue> compared;
  if (result.CountKept() == 0) return compared;
  for (const PublishedValue& value : PublishedValueList()) {
    const TrialMeasure& measure = FindMeasure(value.measure);
    const MeasureTable table = MakeMeasureTable(result, measure);
    if (!value.is_slope) {
      compared.push_back({&value, &measure, SummariseRows(table), "", {}});
      continue;
    }
    for (size_t factor = 0; factor < table.factors.size(); ++factor) {
      const std::string& name = table.factors[factor].name;
      if (!EndsWith(name, value.unit_end)) continue;
      const Answer<std::vector<PersonPoint>> points = ListPoints(table, factor);
      if (!points) continue;
      compared.push_back(
          {&value, &measure, SummariseRows(table), name, CalcPersonSlopes(*points, 0.0)});
    }
  }
  return compared;
}

}  // namespace graspbench
