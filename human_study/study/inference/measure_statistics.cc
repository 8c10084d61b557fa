#include "human_study/study/inference/measure_statistics.h"

#include <map>

#include "core/statistics/multiple_tests.h"

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

}  // namespace graspbench
