// Studies as poor as they come: whatever is asked of them, the answer is a number or a reason.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/statistics/bootstrap.h"
#include "human_study/statistics/condition_means.h"
#include "human_study/statistics/effects_model.h"
#include "human_study/statistics/line_fit.h"
#include "human_study/statistics/location_tests.h"
#include "human_study/statistics/reliability/reliability.h"
#include "human_study/statistics/within_anova.h"

namespace graspbench {
namespace {

/** Few persons, few trials, few different values, holes, huge and tiny scales. */
MeasureTable MakePoorStudy(RandomStream& random) {
  MeasureTable table;
  const int num_factors = random.NextIndex(4);
  for (int f = 0; f < num_factors; ++f) {
    Factor factor;
    factor.name = "f" + std::to_string(f);
    const int num_levels = 1 + random.NextIndex(4);
    for (int level = 0; level < num_levels; ++level) {
      factor.levels.push_back(std::to_string(level));
      factor.numbers.push_back(0.03 * level);
    }
    table.factors.push_back(std::move(factor));
  }
  const int num_persons = random.NextIndex(6);
  const int num_trials = 1 + random.NextIndex(3);
  const double scale = std::pow(10.0, random.NextUniform(-12.0, 12.0));
  const double offset = random.NextIndex(2) * 1000.0 * scale;
  const double missing_share = random.NextIndex(3) * 0.1;
  const int num_values = 1 + random.NextIndex(4);
  const bool is_coarse = random.NextIndex(2) == 0;
  const size_t num_cells = ListCells(table.factors).size();
  const int num_groups = random.NextIndex(4);
  if (num_groups > 0) {
    Factor group;
    group.name = "group";
    for (int level = 0; level < num_groups; ++level) group.levels.push_back(std::to_string(level));
    table.groups.push_back(group);
  }
  const bool has_sessions = random.NextIndex(2) == 0;
  if (has_sessions) table.sessions = {"0", "1"};
  for (int person = 0; person < num_persons; ++person) {
    for (size_t cell = 0; cell < num_cells; ++cell) {
      for (int trial = 0; trial < num_trials; ++trial) {
        Observation row;
        row.person = std::to_string(person);
        if (num_groups > 0) row.groups.push_back(std::to_string(person % num_groups));
        if (has_sessions) row.session = std::to_string(trial % 2);
        size_t rest = cell;
        row.levels.resize(table.factors.size());
        for (size_t f = table.factors.size(); f-- > 0;) {
          row.levels[f] = table.factors[f].levels[rest % table.factors[f].levels.size()];
          rest /= table.factors[f].levels.size();
        }
        const double value = is_coarse ? random.NextIndex(num_values) : random.NextNormal();
        row.value = random.NextUnit() < missing_share ? NAN : offset + scale * value;
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

class PoorStudy : public testing::TestWithParam<int> {
 protected:
  void ExpectFinite(double value, const char* what) {
    EXPECT_TRUE(std::isfinite(value)) << what << " is " << value;
    ++num_numbers_;
  }
  void ExpectP(double p, const char* what) {
    EXPECT_TRUE(p >= 0.0 && p <= 1.0) << what << " is " << p;
    ++num_numbers_;
  }
  template <typename T>
  bool HasValue(const Answer<T>& answer) {
    EXPECT_NE(answer.has_value(), !answer.reason().empty());
    return answer.has_value();
  }

  void CheckCells(const CellMeans& cells) {
    for (BarKind kind : ListBarKinds()) {
      const auto widths = CalcHalfWidths(cells, kind);
      if (HasValue(widths)) ExpectFinite(widths->sum(), "half width");
    }
    for (const GroupComparison& pair : CompareGroups(cells)) {
      if (HasValue(pair.test)) ExpectP(pair.p_holm, "Holm, groups");
    }
    for (const PairComparison& pair : ComparePairs(cells)) {
      if (HasValue(pair.test)) ExpectP(pair.p_holm, "Holm");
    }
    const auto friedman = CalcFriedman(cells);
    if (HasValue(friedman)) ExpectP(friedman->p, "Friedman");
    if (cells.means.cols() > 1) {
      const auto column = [&](Eigen::Index c) {
        return std::vector<double>(cells.means.col(c).begin(), cells.means.col(c).end());
      };
      const auto wilcoxon = CalcWilcoxon(column(0), column(1));
      if (HasValue(wilcoxon)) ExpectP(wilcoxon->p, "Wilcoxon");
      const auto equivalence = CalcEquivalence(CalcPairedTTest(column(0), column(1)), {-1.0, 1.0});
      if (HasValue(equivalence)) ExpectP(equivalence->p, "equivalence");
    }
    const auto anova = CalcWithinAnova(cells);
    if (!HasValue(anova)) return;
    for (const WithinEffect& effect : anova->effects) {
      ExpectFinite(effect.ss_effect + effect.ss_error, "sum of squares");
      if (!HasValue(effect.test)) continue;
      ExpectFinite(effect.test->f, "F");
      ExpectP(effect.test->p, "p");
      ExpectP(effect.test->greenhouse_geisser.p, "p, Greenhouse-Geisser");
      ExpectP(effect.test->greenhouse_geisser.epsilon, "epsilon");
      if (HasValue(effect.test->huynh_feldt)) {
        ExpectP(effect.test->huynh_feldt->p, "p, Huynh-Feldt");
        EXPECT_GE(effect.test->huynh_feldt->epsilon,
                  effect.test->greenhouse_geisser.epsilon - 1e-12);
      }
      if (HasValue(effect.test->mauchly)) ExpectP(effect.test->mauchly->p, "Mauchly");
      ExpectP(effect.test->partial_eta_squared, "partial eta squared");
      ExpectP(effect.test->generalised_eta_squared, "generalised eta squared");
    }
  }

  void CheckEffects(const Answer<EffectsModel>& model) {
    if (!HasValue(model)) return;
    ExpectFinite(model->reml_criterion + model->residual_sd, "criterion");
    for (const EffectTest& effect : model->effects) {
      if (HasValue(effect.test)) ExpectP(effect.test->p, "p, effects");
    }
    if (HasValue(model->slope)) {
      ExpectFinite(model->slope->estimate + model->slope->standard_error, "slope");
      if (HasValue(model->slope->test)) ExpectP(model->slope->test->p, "p, slope");
    }
    for (const CellEstimate& cell : model->cells) {
      ExpectFinite(cell.estimate + cell.standard_error, "mean of the model");
      HasValue(cell.test);
    }
  }

  void CheckReliability(const Answer<Reliability>& reliability) {
    if (!HasValue(reliability)) return;
    ExpectFinite(reliability->within_person_interval.high, "upper limit");
    for (const auto& pair :
         {reliability->one_way, reliability->agreement, reliability->consistency}) {
      if (!HasValue(pair)) continue;
      ExpectFinite(pair->single.value, "ICC");
      EXPECT_LE(pair->single.value, 1.0);
      EXPECT_LE(pair->single.interval.low, pair->single.interval.high + 1e-12);
      EXPECT_LE(pair->average.value, 1.0);
    }
    if (HasValue(reliability->trials_needed)) {
      EXPECT_GE(reliability->trials_needed->num_trials, 1);
    }
  }

  int num_numbers_ = 0;
};

TEST_P(PoorStudy, GivesANumberOrAReason) {
  RandomStream random("poor study", std::to_string(GetParam()));
  for (int k = 0; k < 100; ++k) {
    const MeasureTable table = MakePoorStudy(random);
    SCOPED_TRACE("study " + std::to_string(k));
    const auto cells = CalcCellMeans(table);
    if (HasValue(cells)) CheckCells(*cells);
    for (size_t factor = 0; factor < table.factors.size(); ++factor) {
      const auto points = ListPoints(table, factor);
      ASSERT_TRUE(HasValue(points));
      HasValue(CalcPersonSlopes(*points, 0.0).test);
    }
    CheckEffects(FitEffectsModel(table));
    if (!table.factors.empty()) CheckEffects(FitQuantityModel(table, 0));
    const auto retest = CalcRetest(table);
    if (HasValue(retest)) CheckReliability(retest->reliability);
    const auto trials = ListTrials(table, 0);
    ASSERT_TRUE(HasValue(trials));
    CheckReliability(CalcReliability(*trials));
  }
  EXPECT_GT(num_numbers_, 1000);  // not all of them are that poor
}

INSTANTIATE_TEST_SUITE_P(Statistics, PoorStudy, testing::Range(0, 5));

}  // namespace
}  // namespace graspbench
