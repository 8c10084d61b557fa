/** @file
Files that lost frames and were stamped anew, and healthy ones: reaches of generators that know
nothing of the rule (FindFrameJump). */

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/human_study/protocol/protocol_study.h"

namespace graspbench::protocol {
namespace {

constexpr double kLost = 0.05;  // [s]

/** The exporter dropped what came behind a share of the way to the first touch, and counted on. */
Reach LoseFrames(Reach reach, double share) {
  const double touch = *std::min_element(reach.touch_times.begin(), reach.touch_times.end());
  const double interval = reach.times[1] - reach.times[0];
  const auto first = std::lround((reach.onset + share * (touch - reach.onset)) / interval);
  const auto count = std::lround(kLost / interval);
  const auto lose = [&](auto& samples) {
    samples.erase(samples.begin() + first, samples.begin() + first + count);
  };
  for (auto& digit : reach.digits) lose(digit);
  lose(reach.wrist);
  for (auto& marker : reach.object_markers) lose(marker);
  reach.times.resize(reach.wrist.size());
  return reach;
}

template <ReachMaker make_reach, int percent>
Reach MakeBroken(const Conditions& conditions, const std::string& id, int trial) {
  return LoseFrames(make_reach(conditions, id, trial), percent / 100.0);
}

/** How many of the plan's trials are removed as frame jumps. */
int CountJumps(const StudyPlan& plan) { return CountRemovals(RunPlan(plan).result)["frame_jump"]; }

StudyPlan MakePlan(ReachMaker make_reach) {
  StudyPlan plan;
  plan.make_reach = make_reach;
  plan.seed = "frames";
  plan.num_people = 2;
  plan.trials_per_person = 5;
  return plan;
}

TEST(FrameJump, ALossInMidReachRemovesTheTrial) {
  for (const double rate : {100.0, 200.0}) {
    for (const ReachMaker maker : {ReachMaker(MakeBroken<MakeEverydayReach, 40>),
                                   ReachMaker(MakeBroken<MakeStrangerReach, 40>),
                                   ReachMaker(MakeBroken<MakePushedReach, 40>),
                                   ReachMaker(MakeBroken<MakeStrangerReach, 70>)}) {
      StudyPlan plan = MakePlan(maker);
      plan.conditions.rate = rate;
      EXPECT_EQ(CountJumps(plan), 10) << rate << " Hz";
    }
  }
}

TEST(FrameJump, HealthyReachesStay) {
  for (const double rate : {30.0, 60.0, 100.0, 200.0}) {
    for (const ReachMaker maker : {ReachMaker(MakeEverydayReach), ReachMaker(MakeStrangerReach),
                                   ReachMaker(MakePushedReach)}) {
      StudyPlan plan = MakePlan(maker);
      plan.conditions.rate = rate;
      EXPECT_EQ(CountJumps(plan), 0) << rate << " Hz";
    }
  }
}

// Large distances are reached fast; spikes, pushes, turns and exchanged labels are no lost frames.
TEST(FrameJump, HealthyThingsThatGoFastOrWrongStay) {
  const auto expect_none = [](const char* what, auto&& change) {
    StudyPlan plan = MakePlan(MakeEverydayReach);
    change(plan.conditions);
    EXPECT_EQ(CountJumps(plan), 0) << what;
  };
  expect_none("fast", [](Conditions& c) { c.distances = {0.7, 0.9}; });
  expect_none("spikes", [](Conditions& c) { c.spike_share = 0.01; });
  expect_none("small spikes", [](Conditions& c) { c.spike_share = 0.05, c.spike_size = 4e-3; });
  expect_none("push", [](Conditions& c) { c.push = 0.01, c.is_push_at_once = true; });
  expect_none("turn", [](Conditions& c) { c.push = 0.01, c.turn = 0.3; });
  expect_none("swapped", [](Conditions& c) { c.is_swapped = true; });
  expect_none("regrasp", [](Conditions& c) { c.regrasping_digit = 2; });
  expect_none("tremor", [](Conditions& c) { c.tremor = 1e-3; });
  expect_none("noise", [](Conditions& c) { c.noise_sd = 2e-3; });
}

/** From the way's middle on every marker, the object's too, is 8 mm aside. */
Reach MakeShifted(const Conditions& conditions, const std::string& id, int trial) {
  Reach reach = MakeStrangerReach(conditions, id, trial);
  const auto shift = [](auto& samples) {
    for (size_t i = samples.size() / 3; i < samples.size(); ++i) samples[i].x() += 8e-3;
  };
  for (auto& digit : reach.digits) shift(digit);
  shift(reach.wrist);
  for (auto& marker : reach.object_markers) shift(marker);
  return reach;
}

TEST(FrameJump, AShiftOfTheFrameOfReferenceRemovesTheTrial) {
  EXPECT_EQ(CountJumps(MakePlan(MakeShifted)), 10);
}

// The frame count of a slow camera: cut-offs follow it, and the contacts are as good as it allows.
TEST(SlowCamera, ThirtyHertzAreAnalysedWithoutAnySetting) {
  StudyPlan plan = MakePlan(MakeStrangerReach);
  plan.conditions.rate = 30.0;
  plan.num_people = 4;
  plan.trials_per_person = 10;
  const Judged judged = RunPlan(plan);
  const Accuracy accuracy = CompareWithTruth(judged);
  EXPECT_GE(accuracy.num_kept, 32);
  EXPECT_LT(std::abs(accuracy.bias), 0.005);
  EXPECT_LT(accuracy.sd, 0.015);
  EXPECT_GT(accuracy.coverage, 0.9);
  for (const StudyTrial& trial : judged.result.trials) {
    EXPECT_NE(trial.removed_code, "cutoff_too_high") << trial.removed;
  }
  EXPECT_LT(judged.result.study.config.analysis.contact.cutoff, 12.0) << "as used";
}

}  // namespace
}  // namespace graspbench::protocol
