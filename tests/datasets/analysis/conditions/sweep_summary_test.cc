#include "datasets/analysis/conditions/sweep_summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {

namespace {

constexpr int kNumObjects = 6, kNumTrials = 3;

/** sigma is what a law says of two factors, objects and draws; who succeeds is planted, too. */
class PlantedSweep : public testing::Test {
 protected:
  PlantedSweep() {
    session_.config.conditions = {{"A", {"model.mass_scale=2.0"}},
                                  {"B", {"model.friction_scale=0.8"}},
                                  {"AB", {"model.mass_scale=2.0", "model.friction_scale=0.8"}}};
  }

  template <class Sigma, class Success>
  void Plant(Sigma calc_sigma, Success succeeds) {
    for (int object = 0; object < kNumObjects; ++object) {
      for (int trial = 0; trial < kNumTrials; ++trial) {
        for (int c = 0; c < 4; ++c) {
          TrialRecord record;
          record.plan = {"id" + std::to_string(session_.plan.size()),
                         "tum",
                         "object" + std::to_string(object),
                         "g1",
                         trial,
                         std::nullopt};
          if (c > 0) {
            record.plan.condition = session_.config.conditions[static_cast<size_t>(c) - 1].name;
          }
          const bool a = c == 1 || c == 3, b = c >= 2;
          record.result.stability.sigma = calc_sigma(a, b, object, trial);
          record.result.outcome =
              succeeds(a, b, object, trial) ? Outcome::kSuccess : Outcome::kNoContact;
          session_.plan.push_back(record.plan);
          session_.records.push_back(record);
        }
      }
    }
  }
  static const SweepEffect& Find(const std::vector<SweepEffect>& effects, const std::string& name,
                                 const std::string& measure) {
    for (const SweepEffect& effect : effects) {
      if (NameEffect(effect) == name && effect.measure == measure) return effect;
    }
    ADD_FAILURE() << name << " " << measure;
    return effects.front();
  }

  Session session_;
};

// sigma = 5 + object + trial/10 + (2 + e_o) a + (-1) b + (0.5 + f_o) a b, the means of e_o and f_o
// over objects 0: by hand the effect of A over both levels of B is 2 + 0.5 / 2, that of B
// -1 + 0.5 / 2, their interaction 0.5.
TEST_F(PlantedSweep, EffectsAreThoseOfTheClosedForm) {
  const auto e = [](int object) { return 0.1 * (object - 2.5); };
  Plant(
      [&](bool a, bool b, int object, int trial) {
        return 5.0 + object + 0.1 * trial + (a ? 2.0 + e(object) : 0.0) - (b ? 1.0 : 0.0) +
               (a && b ? 0.5 - e(object) : 0.0);
      },
      [](bool a, bool, int object, int) { return !a || object % 2 == 0; });
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& a = Find(summary.effects, "model.mass_scale=2.0", "sigma_n");
  EXPECT_NEAR(a.change.estimate, 2.25, 1e-12);
  EXPECT_EQ(a.change.num_draws, kNumObjects * kNumTrials);
  EXPECT_EQ(a.change.num_objects, kNumObjects);
  EXPECT_TRUE(a.excludes_zero());
  EXPECT_LT(a.change.interval->low, 2.25);
  EXPECT_GT(a.change.interval->high, 2.25);
  EXPECT_FALSE(a.is_marginal);
  EXPECT_NEAR(Find(summary.effects, "model.friction_scale=0.8", "sigma_n").change.estimate, -0.75,
              1e-12);
  const SweepEffect& both =
      Find(summary.interactions, "model.mass_scale=2.0 and model.friction_scale=0.8", "sigma_n");
  EXPECT_NEAR(both.change.estimate, 0.5, 1e-12);
  EXPECT_TRUE(both.excludes_zero());
  // Under A every second object fails: a change of -1/2, whatever B.
  EXPECT_NEAR(Find(summary.effects, "model.mass_scale=2.0", "success").change.estimate, -0.5,
              1e-12);
  EXPECT_NEAR(Find(summary.effects, "model.friction_scale=0.8", "success").change.estimate, 0.0,
              1e-12);
  EXPECT_NEAR(summary.rows[1].medians[0], 0.5, 1e-12);
  EXPECT_NE(summary.rows[0].undecided.find("success not testable: all 18 trials succeed"),
            std::string::npos);
  EXPECT_TRUE(summary.rows[1].undecided.empty());
}

// Objects that differ as much as the effect is large: an interval over 18 draws as if they were
// independent would exclude 0; that over six objects must not.
TEST_F(PlantedSweep, IntervalsRespectThatDrawsOfAnObjectAreAlike) {
  Plant([](bool a, bool, int object,
           int trial) { return a ? (object < 4 ? 1.0 : -1.2) + 0.01 * trial : 0.0; },
        [](bool, bool, int, int) { return true; });
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& a = Find(summary.effects, "model.mass_scale=2.0", "sigma_n");
  EXPECT_NEAR(a.change.estimate, (4.0 - 2.4) / 6.0 + 0.01, 1e-12);
  ASSERT_TRUE(a.change.interval);
  EXPECT_FALSE(a.excludes_zero());
  const SweepEffect& success = Find(summary.effects, "model.mass_scale=2.0", "success");
  EXPECT_FALSE(success.change.interval);
  EXPECT_NE(success.change.interval.reason().find("success not testable: all 72 trials succeed"),
            std::string::npos)
      << success.change.interval.reason();
}

TEST_F(PlantedSweep, ADrawWithoutOneOfTheValuesCountsNot) {
  Plant([](bool a, bool b, int, int trial) { return a && b && trial == 0 ? kUnset : 1.0 + a; },
        [](bool, bool, int, int trial) { return trial > 0; });
  session_.records.erase(session_.records.begin());  // the base of one draw
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& a = Find(summary.effects, "model.mass_scale=2.0", "sigma_n");
  EXPECT_EQ(a.change.num_draws, kNumObjects * (kNumTrials - 1));
  EXPECT_NEAR(a.change.estimate, 1.0, 1e-12);
  EXPECT_EQ(summary.rows[0].num_finished, kNumObjects * kNumTrials - 1);
}

// Under A two objects are grasped otherwise, and all their trials fail: the pairs stay pairs, and
// the effect says how many changed grasp.
TEST_F(PlantedSweep, ADrawIsOneDrawWhateverItsGrasp) {
  Plant([](bool, bool, int, int) { return 1.0; },
        [](bool a, bool, int object, int) { return !a || object > 1; });
  for (size_t i = 0; i < session_.plan.size(); ++i) {
    PlannedTrial& planned = session_.plan[i];
    const bool a = planned.condition == "A" || planned.condition == "AB";
    if (a && (planned.object == "object0" || planned.object == "object1")) planned.grasp = "g2";
    session_.records[i].plan = planned;
  }
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& a = Find(summary.effects, "model.mass_scale=2.0", "success");
  EXPECT_EQ(a.change.num_draws, 18);
  EXPECT_EQ(a.num_other_grasp, 6);
  EXPECT_EQ(a.num_left_out, 0);
  EXPECT_NEAR(a.change.estimate, -1.0 / 3.0, 1e-12);
  EXPECT_TRUE(a.change.interval);
  EXPECT_EQ(summary.rows[1].other_grasps, "object0 g1 to g2, object1 g1 to g2");
  EXPECT_EQ(summary.rows[2].other_grasps, "");
}

// Under A two objects are tried with a second grasp, which the base lacks: its trials are left out,
// and what they say decides nothing.
TEST_F(PlantedSweep, SaysWhichDrawsItLeavesOutAndDecidesNothingOfThem) {
  Plant([](bool, bool, int, int) { return 1.0; }, [](bool, bool, int, int) { return true; });
  const std::vector<PlannedTrial> planned = session_.plan;
  for (const PlannedTrial& known : planned) {
    const bool a = known.condition == "A" || known.condition == "AB";
    if (!a || known.object > "object1") continue;
    TrialRecord record;
    record.plan = known;
    record.plan.id = "id" + std::to_string(session_.plan.size());
    record.plan.grasp = "g2";
    record.result.outcome = Outcome::kNoContact;
    session_.plan.push_back(record.plan);
    session_.records.push_back(record);
  }
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& a = Find(summary.effects, "model.mass_scale=2.0", "success");
  EXPECT_EQ(a.change.num_draws, 18);
  EXPECT_EQ(a.num_left_out, 6);
  EXPECT_EQ(a.why_left_out, "6 without a trial in each condition");
  ASSERT_FALSE(a.change.interval);
  EXPECT_EQ(a.change.interval.reason(),
            "success not testable: all 72 trials compared succeed, 12 of 12 left out fail");
}

TEST_F(PlantedSweep, SaysWhatIsNotFinishedAndWhatHasNoValue) {
  Plant([](bool a, bool, int, int trial) { return a && trial == 0 ? kUnset : 1.0; },
        [](bool, bool, int, int) { return false; });
  session_.records.erase(session_.records.begin());  // object0, trial 0
  session_.records.pop_back();                       // object5, trial 2, under AB
  const SweepSummary summary = SummariseSweep(session_, {});
  const SweepEffect& sigma = Find(summary.effects, "model.mass_scale=2.0", "sigma_n");
  EXPECT_EQ(sigma.why_left_out, "2 not finished, 5 without a value");
  EXPECT_EQ(sigma.change.num_draws, 11);
  EXPECT_EQ(sigma.num_left_out, 18 - 11);
  const SweepEffect& success = Find(summary.effects, "model.mass_scale=2.0", "success");
  EXPECT_EQ(success.why_left_out, "2 not finished");
  EXPECT_EQ(success.change.interval.reason(), "success not testable: all 64 trials fail");
  session_.records.front().result.outcome = Outcome::kSuccess;  // of the unfinished draw
  EXPECT_EQ(Find(SummariseSweep(session_, {}).effects, "model.mass_scale=2.0", "success")
                .change.interval.reason(),
            "success not testable: all 64 trials compared fail, 1 of 6 left out succeeds");
}

TEST_F(PlantedSweep, HasTablesWithTheirDictionaries) {
  Plant([](bool a, bool, int, int) { return 1.0 + a; },
        [](bool, bool, int object, int) { return object > 0; });
  const std::vector<ExportTable> tables = MakeSweepTables(SummariseSweep(session_, {}));
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].csv.substr(0, tables[0].csv.find('\n')),
            "condition,model_mass_scale,model_friction_scale,hand,planned,finished,successes,"
            "numerical_failures,median_gft_ratio,median_sigma_n,median_breaking_force_n,"
            "median_threshold_margin,median_threshold_force_n,other_grasps,undecided");
  EXPECT_NE(tables[1].csv.find("\nmodel.mass_scale,2.0,,,tum,sigma_n,18,6,0,1.0,,,"),
            std::string::npos)
      << tables[1].csv;
  EXPECT_EQ(tables[0].schema.at("fields").size(), 15u);
  EXPECT_EQ(tables[1].schema.at("fields").size(), 17u);
}

TEST(SweepMeasures, AThresholdEntersEffectsAsItsLogarithm) {
  const SweepMeasure& measure = FindSweepMeasure("threshold_margin");
  const TrialRecord record;
  SweepTrial trial;
  trial.record = &record;
  EXPECT_TRUE(std::isnan(measure.CalcEffectValue(trial)));
  trial.thresholds[0] = 4.0;
  EXPECT_DOUBLE_EQ(measure.CalcEffectValue(trial), 2.0);
  // Never held: one of sixteen equal steps above the largest margin, 16.
  trial.thresholds[0] = HUGE_VAL;
  EXPECT_DOUBLE_EQ(measure.CalcEffectValue(trial), 4.25);
  EXPECT_DOUBLE_EQ(FindSweepMeasure("success").CalcEffectValue(trial), 0.0);
}

TEST(SweepMeasures, AChangeOfAThresholdIsShownAsARatio) {
  const SweepMeasure& measure = FindSweepMeasure("threshold_force_n");
  EXPECT_EQ(FormatChange(measure, 1.0), "x 2.00");
  EXPECT_EQ(FormatChangeInterval(measure, {-1.0, 1.0}), "x 0.50 to 2.00");
  EXPECT_EQ(FormatValue(measure, HUGE_VAL), "none held");
  EXPECT_EQ(FormatValue(measure, kUnset), "n/a");
  EXPECT_EQ(FormatChange(FindSweepMeasure("success"), -0.25), "-25.0");
}

}  // namespace

}  // namespace graspbench
