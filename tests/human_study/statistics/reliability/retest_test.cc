#include "human_study/statistics/reliability/retest.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

/** The ratings of Shrout and Fleiss (1979), judges as sessions; every session has two trials about
the rating, and two conditions that differ by 2. */
MeasureTable MakeSessions() {
  const double ratings[6][4] = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  MeasureTable table;
  table.factors = {{"side", {"left", "right"}, {}, ""}};
  table.sessions = {"1", "2", "3", "4"};
  for (int person = 0; person < 6; ++person) {
    for (int session = 0; session < 4; ++session) {
      for (const int side : {0, 1}) {
        for (const double off : {-0.25, 0.25}) {
          table.rows.push_back({"P" + std::to_string(person),
                                "",
                                {side == 0 ? "left" : "right"},
                                ratings[person][session] + off + (side == 0 ? -1.0 : 1.0),
                                {},
                                std::to_string(session + 1)});
        }
      }
    }
  }
  return table;
}

TEST(Retest, IsShroutAndFleissOfTheSessionsMeans) {
  const Answer<Retest> retest = CalcRetest(MakeSessions());
  ASSERT_TRUE(retest) << retest.reason();
  ASSERT_TRUE(retest->reliability) << retest->reliability.reason();
  EXPECT_NEAR(retest->reliability->agreement->single.value, 0.29, 0.005);
  EXPECT_NEAR(retest->reliability->consistency->single.value, 0.71, 0.005);
  ASSERT_EQ(retest->shifts.size(), 3u);
  EXPECT_NEAR(retest->shifts[0].test->mean, 15.0 / 6.0 - 46.0 / 6.0, 1e-12);
}

TEST(Retest, ASessionMayBeAFactorToo) {
  MeasureTable table = MakeSessions();
  table.factors.push_back({"day", table.sessions, {}, ""});
  for (Observation& row : table.rows) row.levels.push_back(row.session);
  const Answer<Retest> retest = CalcRetest(table);
  ASSERT_TRUE(retest) << retest.reason();
  EXPECT_NEAR(retest->reliability->agreement->single.value, 0.29, 0.005);
}

TEST(Retest, LeavesOutWhoMissedASession) {
  MeasureTable table = MakeSessions();
  for (Observation& row : table.rows) {
    if (row.person == "P2" && row.session == "3" && row.levels[0] == "left") row.value = NAN;
  }
  const Answer<Retest> retest = CalcRetest(table);
  ASSERT_TRUE(retest) << retest.reason();
  EXPECT_EQ(retest->persons.size(), 5u);
  ASSERT_EQ(retest->left_out.size(), 1u);
  EXPECT_EQ(retest->left_out[0].reason, "no value in left, 3");
}

TEST(Retest, GivesReasons) {
  MeasureTable table = MakeSessions();
  table.sessions = {"1"};
  EXPECT_EQ(CalcRetest(table).reason(), "1 session; expected 2 or more");
  table = MakeSessions();
  table.rows[0].session.clear();
  EXPECT_NE(CalcRetest(table).reason().find("is not a level of factor \"session"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
