#include "human_study/study/inference/opening_reliability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/random.h"
#include "human_study/study/run/run_study.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

/** What a made-up hand does: its width, which all measures see, and each measure's own error. */
struct HandModel {
  int num_persons = 10;
  int num_trials = 4;  ///< of each person and size
  std::vector<std::string> sizes = {"0.03", "0.05", "0.07"};
  double slope = 0.8;
  double person_sd = 0.008, trial_sd = 0.004, own_sd = 0.004;  ///< [m]
  /** Factor of own_sd by index of the opening. */
  std::function<double(size_t)> noise = [](size_t) { return 1.0; };
  /** What a digit's loss multiplies the noise by. */
  double loss = 1.0;
};

StudyResult MakeStudy(const HandModel& model, const std::string& seed) {
  StudyResult result;
  result.digits = {"TH", "FF", "MF", "RF", "LF"};
  Factor factor;
  factor.name = "diameter_m";
  factor.levels = model.sizes;
  for (const std::string& size : model.sizes) factor.numbers.push_back(std::stod(size));
  result.study.factors = {factor};
  RandomStream random(seed, "hands");
  for (int person = 0; person < model.num_persons; ++person) {
    const double own = 0.04 + model.person_sd * random.NextNormal();
    const double slope = model.slope * (1.0 + 0.1 * random.NextNormal());
    for (size_t size = 0; size < model.sizes.size(); ++size) {
      for (int repeat = 0; repeat < model.num_trials; ++repeat) {
        StudyTrial trial;
        trial.participant = "p" + std::to_string(person);
        trial.levels = {model.sizes[size]};
        const double object = factor.numbers[size];
        const double width = own + slope * object + model.trial_sd * random.NextNormal();
        const double grip = object + 0.25 * model.trial_sd * random.NextNormal();
        for (size_t i = 0; i < HandOpeningList().size(); ++i) {
          const double noise = model.own_sd * model.noise(i);
          OpeningValues values;
          values.open = width + noise * random.NextNormal();
          values.closed = grip + 0.25 * noise * random.NextNormal();
          values.open_without.push_back(std::nan(""));
          values.closed_without.push_back(std::nan(""));
          for (size_t digit = 1; digit < result.digits.size(); ++digit) {
            values.open_without.push_back(width + model.loss * noise * random.NextNormal());
            values.closed_without.push_back(grip + 0.25 * noise * random.NextNormal());
          }
          trial.openings.push_back(values);
        }
        result.trials.push_back(trial);
      }
    }
  }
  return result;
}

StudyResult Analyse(StudyResult result) {
  result.statistics.openings = CalcOpeningReliability(result);
  return result;
}

bool HasFinding(const OpeningFamily& family) {
  for (const OpeningReliability& row : family.rows) {
    for (const OpeningComparison& comparison : row.against_aperture) {
      if (comparison.IsBetter() || comparison.IsWorse()) return true;
    }
  }
  return false;
}

TEST(OpeningReliability, CriteriaAreWhatThePlantedSpreadsGive) {
  HandModel model;
  model.num_persons = 150;
  model.num_trials = 10;
  const OpeningFamily family = Analyse(MakeStudy(model, "large")).statistics.openings;
  const OpeningReliability& row = family.rows[1];
  const double open_sd = std::hypot(0.004, 0.004), closed_sd = 0.25 * open_sd;
  EXPECT_NEAR(row.within_person_sd, open_sd, 0.03 * open_sd);
  const double spread = std::sqrt((open_sd * open_sd + closed_sd * closed_sd) / 2.0);
  EXPECT_NEAR(*row.criteria[1], (0.04 + (0.8 - 1.0) * 0.05) / spread, 0.05 * 0.03 / spread);
  EXPECT_NEAR(*row.criteria[2], 0.8 / open_sd, 0.05 * 0.8 / open_sd);
  // Thirty trials each; persons' slopes differ, too: 0.08 of 0.05 m.
  const double between = std::hypot(0.008, 0.08 * 0.05);
  EXPECT_NEAR(*row.criteria[0], std::sqrt(30.0) * between / open_sd,
              0.15 * std::sqrt(30.0) * between / open_sd);
  for (size_t digit = 1; digit < 5; ++digit) EXPECT_NEAR(*row.kept_without[digit], 1.0, 0.05);
  EXPECT_FALSE(row.kept_without[0]);  // the thumb is never left out
}

// A constant added to a measure, or another unit, is no reliability: the coefficient of variation
// would have taken it for one.
TEST(OpeningReliability, ConstantsAndUnitsChangeNothing) {
  const StudyResult plain = Analyse(MakeStudy(HandModel(), "metamorphic"));
  StudyResult changed = plain;
  for (StudyTrial& trial : changed.trials) {
    const auto change = [](double& value) { value = 3.0 * (value + 0.5); };
    OpeningValues& values = trial.openings[3];
    change(values.open);
    change(values.closed);
    for (double& value : values.open_without) change(value);
    for (double& value : values.closed_without) change(value);
  }
  changed = Analyse(changed);
  const OpeningReliability& a = plain.statistics.openings.rows[3];
  const OpeningReliability& b = changed.statistics.openings.rows[3];
  EXPECT_NEAR(b.within_person_sd, 3.0 * a.within_person_sd, 1e-12);
  for (size_t i = 0; i < kNumOpeningCriteria; ++i) {
    EXPECT_NEAR(b.against_aperture[i].ratio, a.against_aperture[i].ratio, 1e-9) << i;
    EXPECT_NEAR(b.against_aperture[i].p_holm, a.against_aperture[i].p_holm, 1e-9) << i;
  }
}

// 32 comparisons of measures that are all as good as the aperture: any finding is false.
TEST(OpeningReliability, EqualMeasuresAreFoundDifferentInFivePerCentOfStudies) {
  constexpr int kNumStudies = 200;
  for (const int num_persons : {5, 8, 16}) {
    HandModel model;
    model.num_persons = num_persons;
    int num_false = 0;
    for (int i = 0; i < kNumStudies; ++i) {
      num_false += HasFinding(
          Analyse(MakeStudy(model, std::to_string(num_persons) + " " + std::to_string(i)))
              .statistics.openings);
    }
    EXPECT_LE(num_false, 17) << num_persons;  // 99 % of studies at a rate of 0.05
    RecordProperty("false_" + std::to_string(num_persons), num_false);
  }
}

TEST(OpeningReliability, AMeasureWithLessErrorIsFoundAndOneWithMoreIsCalledWorse) {
  HandModel model;
  model.num_persons = 12;
  model.noise = [](size_t i) { return i == 1 ? 0.2 : i == 2 ? 3.0 : 1.0; };
  int num_shown = 0, num_worse = 0;
  for (int i = 0; i < 50; ++i) {
    const OpeningFamily family =
        Analyse(MakeStudy(model, "better " + std::to_string(i))).statistics.openings;
    num_shown += family.rows[1].verdict() == OpeningVerdict::kShown;
    num_worse += family.rows[2].verdict() == OpeningVerdict::kWorse;
  }
  EXPECT_GE(num_shown, 45);
  EXPECT_GE(num_worse, 45);
}

TEST(OpeningReliability, TheSentenceSaysWhatCouldBeTested) {
  HandModel model;
  model.num_persons = 1;
  const std::string one = DescribeOpeningArgument(Analyse(MakeStudy(model, "one")));
  EXPECT_EQ(one,
            "More reliable than the aperture: not testable with 1 person (5 or more are needed).");
  model.num_persons = 12;
  model.noise = [](size_t i) { return i == 1 ? 0.2 : 1.0; };
  StudyResult study = Analyse(MakeStudy(model, "twelve"));
  const std::string shown = DescribeOpeningArgument(study);
  EXPECT_EQ(shown.find("More reliable than the aperture: shown for virtual_finger. "), 0u) << shown;
  ExpectHolds(shown, "(12 persons, 32 comparisons)");
  study.study.config.analysis.opening.measure = "aperture";
  ExpectHolds(DescribeOpeningArgument(study), "the study's own opening is the aperture itself");
  study.digits = {"TH", "FF"};
  EXPECT_EQ(
      DescribeOpeningArgument(study),
      "More reliable than the aperture: not testable with 2 digits: every opening is then the "
      "aperture.");
}

TEST(OpeningReliability, GivesReasons) {
  // Equal measures, one trial a condition, a factor that the hand does not follow.
  HandModel model;
  model.own_sd = 0.0;
  OpeningFamily family = Analyse(MakeStudy(model, "equal")).statistics.openings;
  EXPECT_EQ(family.rows[1].against_aperture[1].no_answer,
            "the statistic is the same for every resample");
  EXPECT_EQ(family.rows[1].verdict(), OpeningVerdict::kNotTestable);
  model = HandModel();
  model.num_trials = 1;
  family = Analyse(MakeStudy(model, "once")).statistics.openings;
  EXPECT_EQ(family.rows[1].criteria[1].reason(),
            "nobody has two trials in a condition that differ");
  model = HandModel();
  model.slope = -0.5;
  family = Analyse(MakeStudy(model, "shrinks")).statistics.openings;
  EXPECT_EQ(family.rows[1].against_aperture[2].no_answer,
            "the aperture does not grow with diameter_m");
  EXPECT_EQ(Analyse(StudyResult()).statistics.openings.rows[0].criteria[0].reason(),
            "no trial has a value");
}

}  // namespace
}  // namespace graspbench
