#include "workbench/tables/simultaneity_tables.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

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

}  // namespace
}  // namespace graspbench
