#include "workbench/tables/sweep_tables.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(SweepTables, NameInteractionsThatExcludeZeroAndConditionsThatDecideNothing) {
  SweepSummary summary;
  ConditionRow row;
  row.hand = "tum";
  row.num_finished = 4;
  row.medians = {1.0, 0.25, 1.5, kUnset};
  row.undecided = "cannot decide success: all 4 trials succeed";
  summary.rows = {row};
  SweepEffect effect;
  effect.factors = {"model.mass_scale"};
  effect.levels = {"2.0"};
  effect.measure = "sigma_n";
  effect.hand = "tum";
  effect.num_draws = 4;
  effect.estimate = -0.5;
  effect.interval = NoAnswer{"fewer than five objects"};
  summary.effects = {effect};
  effect.factors.push_back("grasp");
  effect.levels.push_back("g2");
  effect.interval = Interval{-0.75, -0.25};
  summary.interactions = {effect};
  EXPECT_EQ(FormatSweepTables(summary),
            "condition  hand  trials  success [%]  GFT% [%]  sigma [N]  breaking force [N]\n"
            "base       tum        4  100.0 *          25.0       1.50                 n/a\n"
            "rate of success, medians of the rest\n"
            "* cannot decide success: all trials of the condition succeed, or none\n"
            "\n"
            "level                 hand  measure    draws  change  95 % interval\n"
            "model.mass_scale=2.0  tum   sigma [N]      4   -0.50  fewer than five objects\n"
            "against the base's level, on the same draws; intervals from drawing objects\n"
            "\n"
            "interactions whose interval excludes 0\n"
            "level                              hand  measure    draws  change  95 % interval\n"
            "model.mass_scale=2.0 and grasp=g2  tum   sigma [N]      4   -0.50  -0.75 to -0.25\n");
  summary.effects[0].num_left_out = 2;
  summary.effects[0].why_left_out = "2 without a value";
  EXPECT_NE(FormatSweepTables(summary).find(
                "level                 hand  measure    draws   change  95 % interval            "
                "left out\n"
                "model.mass_scale=2.0  tum   sigma [N]  4 of 6   -0.50  fewer than five objects  "
                "2 without a value\n"),
            std::string::npos)
      << FormatSweepTables(summary);
  summary.interactions[0].interval = Interval{-0.75, 0.25};
  EXPECT_NE(FormatSweepTables(summary).find("no interval of an interaction excludes 0\n"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
