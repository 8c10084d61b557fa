#include "workbench/tables/experiment_tables.h"

#include <gtest/gtest.h>

#include <cmath>

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
  for (const char* part :
       {"\ncompliant  1 of 2  ", "\nn of N trials: the others are not finished"}) {
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
  EXPECT_EQ(
      FormatSensitivityTables(summary),
      "setting               was  hand  pairs  success [%]           GFT [ms]                "
      "        GFT% [%]                           sigma [N]\n"
      "model.mass_scale=2.0  1.0  tum      10  -30.0 (-60.0 to 5.0)  100 (50 to 250), 6 of 10 "
      "pairs  10.0 (5.0 to 25.0), 6 of 10 pairs  n/a, 0 of 10 pairs\n"
      "changes of the success rate and of medians, with 95 % intervals, on the same "
      "draws\n"
      "n of N pairs: in each other pair a trial has no value\n");
  summary.changes[0].measures.assign(5, {"gft_s", 10, 0.1, 0.2, kUnset, kUnset, ""});
  summary.changes[0].measures[1].measure = "gft_ratio";
  summary.changes[0].measures[2].measure = "sigma_n";
  summary.changes[0].num_left_out = 4;
  summary.changes[0].why_left_out = "4 without a trial under the setting";
  EXPECT_EQ(FormatSensitivityTables(summary),
            "setting               was  hand  pairs     success [%]           GFT [ms]  GFT% [%]  "
            "sigma [N]  left out\n"
            "model.mass_scale=2.0  1.0  tum   10 of 14  -30.0 (-60.0 to 5.0)       100      10.0  "
            "     0.10  4 without a trial under the setting\n"
            "changes of the success rate and of medians, with 95 % intervals, on the same "
            "draws\n");
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
  EXPECT_EQ(FormatRelations({row, none}),
            "hand  of the trial  measure  trials  conditions  rank correlation\n"
            "tum   success [%]   GFT          80           8  -0.50 (-0.70 to -0.25) *\n"
            "tum   success [%]   GOT           0           0  n/a\n"
            "within conditions (hand, object, grasp), with 95 % intervals; * differs from 0 at 5 % "
            "over all rows (Holm)\n");
}

TEST(SimultaneityTables, NothingButMissingRelationsIsASentence) {
  const GraspResponse* success = &ListGraspResponses().front();
  const SimultaneityRelation none = {"tum", "got_s", success, NoAnswer{"all alike"}, kUnset};
  const std::string text = FormatRelations({none, none});
  EXPECT_EQ(text.find("no relation can be found"), 0u) << text;
  EXPECT_EQ(text.find("n/a"), std::string::npos);
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
  EXPECT_NE(partial.find("\nn of N trials: the others have no value at some delay\n"),
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

TEST(ThresholdTables, ChangesAreRatios) {
  EXPECT_EQ(FormatThresholdChanges({}), "");
  const std::string text =
      FormatThresholdChanges({{&kThresholdScales[0], "tum", 20, 3, 4, 13, 1.41, 1.19, 2.0}});
  EXPECT_NE(text.find("1.41 (1.19 to 2.00)"), std::string::npos) << text;
}

}  // namespace
}  // namespace graspbench
