#include "workbench/tables/experiment_tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/map/made_map.h"

namespace graspbench {

namespace {

NumericsComparison MakeFlip() {
  NumericsComparison comparison;
  comparison.variant = "half step";
  TrialRecord& before = comparison.before;
  before.plan = {"cup7", "tum", "cup", "g1", 7};
  before.result.outcome = Outcome::kSuccess;
  before.result.timing = {0.5, kUnset, kUnset, kUnset, kUnset, false};
  before.result.stability.sigma = 2.0;
  comparison.after = before;
  comparison.after.result.outcome = Outcome::kNoContact;
  comparison.after.result.timing.gct = kUnset;
  return comparison;
}

TEST(NumericsTables, TablesListTheFlips) {
  const std::vector<NumericsComparison> flipped = {MakeFlip()};
  const std::string text = FormatNumericsTables(SummariseNumerics(flipped), flipped);
  EXPECT_NE(text.find("half step  tum   cup     g1         7  success  no contact\n"),
            std::string::npos)
      << text;
  std::vector<NumericsComparison> same = flipped;
  same[0].after.result = same[0].before.result;
  same[0].after.result.stability.sigma = 2.5;
  const std::string calm = FormatNumericsTables(SummariseNumerics(same), same);
  EXPECT_NE(calm.find("no verdict flips\n"), std::string::npos) << calm;
  EXPECT_NE(calm.find("25 (25)"), std::string::npos) << calm;
  std::vector<NumericsComparison> partial(3, MakeFlip());
  partial[1].before.plan.id = "cup8";
  partial[2].variant = "compliant";
  const std::string short_of_one = FormatNumericsTables(SummariseNumerics(partial), partial);
  for (const char* part : {"\ncompliant  1 of 2  ", "\nn of N trials: the others are unfinished"}) {
    EXPECT_NE(short_of_one.find(part), std::string::npos) << short_of_one;
    EXPECT_EQ(calm.find(part), std::string::npos) << calm;
  }
}

TEST(SensitivityTables, ShowChangesWithTheirIntervals) {
  SettingChange change;
  change.setting = "model.mass_scale=2.0";
  change.value = "1.0";
  change.hand = "tum";
  change.successes.both = 6;
  change.successes.first_only = 3;
  change.successes.neither = 1;
  change.rate_change_low = -0.6;
  change.rate_change_high = 0.05;
  for (const char* measure : {"gct_s", "gft_s", "gft_ratio", "got_ratio", "sigma_n"}) {
    change.measures.push_back({measure, 6, 0.1, 0.2, 0.05, 0.25, ""});
  }
  change.measures.back() = {"sigma_n", 0, kUnset, kUnset, kUnset, kUnset, "no pair has it twice"};
  SensitivitySummary summary;
  summary.changes = {change};
  summary.changes[0].num_objects = 5;
  EXPECT_EQ(FormatSensitivityTables(summary),
            "setting               was  hand  pairs  objects  success [%]           GFT [ms]       "
            "                 GFT% [%]                           sigma [N]\nmodel.mass_scale=2.0  "
            "1.0  tum      10        5  -30.0 (-60.0 to 5.0)  100 (50 to 250), 6 of 10 pairs  10.0 "
            "(5.0 to 25.0), 6 of 10 pairs  n/a, 0 of 10 pairs\nmean changes over pairs of the same "
            "draw, with 95 % intervals from resampling objects (success with fewer than 5 objects: "
            "these objects only)\nn of N pairs: in the other pairs one of the trials does not have "
            "this measure\n");
  summary.changes[0].measures.assign(5, {"gft_s", 10, 0.1, 0.2, kUnset, kUnset, ""});
  summary.changes[0].measures[1].measure = "gft_ratio";
  summary.changes[0].measures[2].measure = "sigma_n";
  summary.changes[0].num_left_out = 4;
  summary.changes[0].why_left_out = "4 without a partner";
  summary.changes[0].num_other_grasp = 1;
  EXPECT_EQ(FormatSensitivityTables(summary),
            "setting               was  hand  pairs     objects  success [%]           GFT [ms]  "
            "GFT% [%]  sigma [N]  other grasp  left out\nmodel.mass_scale=2.0  1.0  tum   10 of 14 "
            "       5  -30.0 (-60.0 to 5.0)       100      10.0       0.10  1 pair       4 without "
            "a partner\nmean changes over pairs of the same draw, with 95 % intervals from "
            "resampling objects (success with fewer than 5 objects: these objects only)\n");
}

TEST(SimultaneityTables, ARelationIsShownWithItsIntervalAndMarkedWhenItHolds) {
  WithinCorrelation found;
  found.num_groups = 8;
  found.num_pairs = 80;
  found.correlation = -0.5;
  found.interval = Interval{-0.7, -0.25};
  const GraspResponse* success = &ListGraspResponses().front();
  const SimultaneityRelation row = {"tum", "gft_s", success, found, 0.01};
  const SimultaneityRelation none = {"tum", "got_s", success, NoAnswer{"all alike"}, kUnset};
  EXPECT_EQ(
      FormatRelations({row, none}),
      "hand  measure  of the trial  conditions  trials  rank correlation             p  p of all\n"
      "tum   GFT      success                8      80  -0.50 (-0.70 to -0.25)  1.0000     0.010\n"
      "tum   GOT      success                0       0  n/a                        n/a       n/a\n"
      "within conditions (hand, object, grasp), with 95 % intervals; p of all: over all rows "
      "(Holm)\n");
}

TEST(SimultaneityTables, ADoseShowsItsMeansInTheUnitOfItsLabel) {
  DoseResponse row;
  row.condition = "light";
  row.digit = "last";
  row.hand = "tum";
  row.response = ListGraspResponses()[1].shown;
  row.num_trials = 12;
  row.means = {0.001, 0.002, 0.003, 0.005, 0.007};
  row.change = 0.002;
  row.interval = Interval{0.0015, 0.0026};
  const std::string text = FormatDoseResponses({row});
  EXPECT_NE(text.find("push before lift-off [mm]"), std::string::npos) << text;
  EXPECT_NE(text.find("1.00 2.00 3.00 5.00 7.00"), std::string::npos) << text;
  EXPECT_NE(text.find("2.00 (1.50 to 2.60)"), std::string::npos) << text;
  EXPECT_NE(text.find("means at 0, 50, 100, 200, 300 ms"), std::string::npos) << text;
  EXPECT_EQ(text.find("no value at some delay"), std::string::npos) << text;
  row.num_left_out = 3;
  const std::string partial = FormatDoseResponses({row});
  EXPECT_NE(partial.find("  12 of 15  "), std::string::npos) << partial;
  EXPECT_NE(partial.find("\nn of N trials: the others lack a value at some delay\n"),
            std::string::npos)
      << partial;
}

TEST(ThresholdTables, SayWhatIsNotKnownAndWhatNeverHeld) {
  ThresholdSummary summary;
  summary.scale = &kThresholdScales[1];
  summary.num_trials = 23;
  summary.cells = {{"", "tum", "can", "g3", 8, 1, 0, {2, 5}, 0.7, 0.5, HUGE_VAL},
                   {"", "tum", "cup", "g3", 2, 2, 0, {}, HUGE_VAL}};
  const std::string text = FormatThresholdTables(summary);
  for (const char* part : {"0.70 N", "0.50 N to none held", "2, 5", "none held", "n/a",
                           "10 draws, 23 trials, 2 not monotone"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(SweepTables, NameInteractionsThatExcludeZeroAndConditionsThatDecideNothing) {
  SweepSummary summary;
  ConditionRow row;
  row.hand = "tum";
  row.num_planned = row.num_finished = 4;
  row.medians = {1.0, 0.25, 1.5, kUnset};
  row.undecided = "success not testable: all 4 trials succeed";
  summary.rows = {row};
  SweepEffect effect;
  effect.factors = {"model.mass_scale"};
  effect.levels = {"2.0"};
  effect.measure = "sigma_n";
  effect.hand = "tum";
  effect.change.num_draws = 4;
  effect.change.estimate = -0.5;
  effect.change.interval = NoAnswer{"fewer than five objects"};
  summary.effects = {effect};
  effect.factors.push_back("grasp");
  effect.levels.push_back("g2");
  effect.change.interval = Interval{-0.75, -0.25};
  summary.interactions = {effect};
  EXPECT_EQ(
      FormatSweepTables(summary),
      "condition  hand  trials  success [%]  GFT% [%]  sigma [N]  breaking force [N]  note\nbase   "
      "    tum        4        100.0      25.0       1.50                 n/a  success not "
      "testable: all 4 trials succeed\nsuccess: rate; other columns: medians\n\nlevel              "
      "   hand  measure    draws  objects  change  95 % interval\nmodel.mass_scale=2.0  tum   "
      "sigma [N]      4        0   -0.50  fewer than five objects\nrelative to the base level, on "
      "the same draws; intervals from resampling objects\n\nsignificant interactions (95 % CI "
      "excludes 0)\nlevel                              hand  measure    draws  objects  change  95 "
      "% interval\nmodel.mass_scale=2.0 and grasp=g2  tum   sigma [N]      4        0   -0.50  "
      "-0.75 to -0.25, excludes 0\n");
  summary.effects[0].num_left_out = 2;
  summary.effects[0].why_left_out = "2 without a value";
  EXPECT_NE(
      FormatSweepTables(summary).find("level                 hand  measure    draws   objects  "
                                      "change  95 % interval            left out\n"
                                      "model.mass_scale=2.0  tum   sigma [N]  4 of 6        0   "
                                      "-0.50  fewer than five objects  2 without a value\n"),
      std::string::npos)
      << FormatSweepTables(summary);
  summary.interactions[0].change.interval = Interval{-0.75, 0.25};
  EXPECT_NE(FormatSweepTables(summary).find("no significant interaction (95 % CI)\n"),
            std::string::npos);
}

TEST(MapTables, BeginWithTheFindingAndListEveryLevel) {
  const std::string text = FormatMap(LoadMap(MakeMapSessionResult()));
  EXPECT_EQ(text.rfind("tum: matters.", 0), 0u) << text;
  for (const MapFactorRow& factor : ListMapFactors()) {
    for (const MapLevelRow& level : factor.levels) {
      EXPECT_NE(text.find(factor.name + " " + level.name), std::string::npos) << level.name;
    }
  }
}

Answer<TouchLags> MakeLags(double thumb) {
  TouchLags lags;
  lags.num_trials = 8;
  lags.closing_time = 0.5;
  lags.gft = 0.5 * thumb;
  lags.shares = {{"TH", thumb, thumb, thumb, 0}, {"FF", 0.0, 0.0, 0.0, 0}};
  return lags;
}

TEST(ScheduleTables, ARowASchedulePeopleFirstThenWhatIsMissing) {
  ScheduleComparison comparison;
  comparison.study = "pilot";
  comparison.scale = &kThresholdScales[0];
  ScheduleCell cell;
  cell.of = {"tum", "can", "g3", {"TH", "FF"}, MakeLags(0.2), {{kPeopleLike, "TH does not touch"}}};
  ScheduleRow natural = {kNatural, MakeLags(HUGE_VAL), {}};
  natural.threshold_text = "1.41";
  natural.ratio = 1.0;
  natural.interval = Interval{1.0, 1.0};
  cell.rows = {natural};
  comparison.cells = {cell};
  const std::string text = FormatSchedules(comparison);
  const auto expect = [&](const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in\n" << text;
  };
  expect("FF 0, TH 20 ");
  expect("FF 0, TH never ");
  expect(" 100\n");  // GFT of people [ms]
  expect("0 of 0");
  expect("1.00 (1.00 to 1.00)");
  expect("not compared: can, tum g3, people-like: TH does not touch\n");
}

TEST(ScheduleTables, ThePlanCountsTrialsAndSaysWhatIsMissing) {
  Session session;
  for (const char* grasp : {"g3-natural", "g3-simultaneous", "g30-natural"}) {
    for (int trial = 0; trial < 4; ++trial) {
      session.plan.push_back({"id", "tum", "can", grasp, trial});
    }
  }
  session.plan.push_back({"id", "tum", "cup", "g3-natural", 0});
  SchedulePlan plan;
  plan.session = &session;
  plan.people.cells = {{"tum", "can", "g3", {}, {}, {{kPeopleLike, "TH never touched"}}}};
  const Json json = ToJson(plan);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["trials"], 4);
  EXPECT_EQ(json[1]["trials"], 4);
  EXPECT_EQ(json[1]["missing"], "");
  EXPECT_EQ(json[2]["trials"], 0);
  EXPECT_EQ(json[2]["missing"], "TH never touched");
  const std::string text = FormatSchedulePlan(plan);
  EXPECT_NE(text.find("TH never touched"), std::string::npos) << text;
}

}  // namespace

}  // namespace graspbench
