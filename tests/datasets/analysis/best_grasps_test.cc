#include "datasets/analysis/best_grasps.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

/** All grasps of the fake hands on the fake objects, ten trials each; `num_held` of "hand object
grasp" succeed, those with the lowest numbers. */
Session MakeTried(const std::map<std::string, int>& num_held) {
  Session session;
  session.config.grasps = {"all"};
  session.plan = MakePlan(session.config, MakeFakeInputs());
  for (const PlannedTrial& planned : session.plan) {
    TrialRecord record = MakeFakeRecord(planned);
    const auto held = num_held.find(planned.hand + " " + planned.object + " " + planned.grasp);
    const bool is_held = held != num_held.end() && planned.trial < held->second;
    record.result.outcome = is_held ? Outcome::kSuccess : Outcome::kPushedAway;
    record.result.stability.sigma = planned.grasp == "g4" ? 2.0 : 1.0;
    session.records.push_back(record);
  }
  return session;
}

std::vector<std::string> ListChoices(const std::vector<BestGrasp>& rows) {
  std::vector<std::string> texts;
  for (const BestGrasp& row : rows) {
    std::string text = row.hand + " " + row.object + " " + (row.best ? row.best->grasp : "none");
    for (const CellSummary* cell : row.tied) text += "=" + cell->grasp;
    text += " " + (row.usual ? row.usual->grasp : "-") + (row.is_usual_worse() ? " worse" : "");
    texts.push_back(text);
  }
  return texts;
}

TEST(BestGraspsTest, TheHigherRateWinsThenTheFirmerThenTheFirst) {
  const Session session = MakeTried({{"tum mug g1", 10},     // the usual g2 never
                                     {"tum pencil g2", 9},   // the usual one
                                     {"shadow mug g2", 10},  // one more than the usual g3
                                     {"shadow mug g3", 9},
                                     {"shadow pencil g1", 8},  // as often as the firmer g4
                                     {"shadow pencil g4", 8}});
  const SessionSummary summary = SummariseSession(session);
  const auto rows = FindBestGrasps(session, summary, MakeFakeInputs());
  EXPECT_EQ(ListChoices(rows),
            (std::vector<std::string>{"tum mug g1 g2 worse", "tum pencil g2 g2", "shadow mug g2 g3",
                                      "shadow pencil g4=g1 g1"}));
  EXPECT_EQ(rows[0].num_tried, 2);
  EXPECT_EQ(rows[2].num_tried, 5);
  EXPECT_FALSE(rows[2].is_usual_as_good());
  EXPECT_TRUE(rows[3].is_usual_as_good());  // by success
  // The same draws won and lost: the interval of the paired difference.
  const Interval expected = CalcPairedDifferenceInterval({9, 0, 1, 0});
  EXPECT_EQ(rows[2].gain.low, expected.low);
  EXPECT_EQ(rows[2].gain.high, expected.high);
}

TEST(BestGraspsTest, WhatNoGraspHeldHasNoBest) {
  const Session session = MakeTried({{"tum mug g1", 1}});
  const SessionSummary summary = SummariseSession(session);
  EXPECT_EQ(ListChoices(FindBestGrasps(session, summary, MakeFakeInputs())),
            (std::vector<std::string>{"tum mug g1 g2", "tum pencil none g2", "shadow mug none g3",
                                      "shadow pencil none g1"}));
}

TEST(BestGraspsTest, WhatWasNotTriedIsNotChosen) {
  Session session = MakeTried({{"tum mug g1", 3}});
  for (size_t k = session.plan.size(); k-- > 0;) {
    if (session.plan[k].hand == "tum" && session.plan[k].grasp == "g1") continue;
    session.plan.erase(session.plan.begin() + static_cast<long>(k));
    session.records.erase(session.records.begin() + static_cast<long>(k));
  }
  const SessionSummary summary = SummariseSession(session);
  EXPECT_EQ(ListChoices(FindBestGrasps(session, summary, MakeFakeInputs())),
            (std::vector<std::string>{"tum mug g1 -", "tum pencil none -"}));
}

}  // namespace
}  // namespace graspbench
