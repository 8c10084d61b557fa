/** @file
People who move otherwise than assumed (MakeEverydayReach): few studies a case; everyday_slow_test.cc
has the figures. */

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "human_study/study/run/trial_removal.h"
#include "tests/human_study/protocol/protocol_study.h"

namespace graspbench::protocol {
namespace {

StudyPlan MakeEverydayPlan(const std::string& seed) {
  StudyPlan plan;
  plan.seed = seed;
  plan.num_people = 2;
  plan.trials_per_person = 9;
  return plan;
}

int CountFlagged(const StudyResult& result, const std::string& flag) {
  int count = 0;
  for (const StudyTrial& trial : result.trials) {
    count += trial.IsKept() && FormatFlags(*trial.analysis).find(flag) != std::string::npos;
  }
  return count;
}

bool HasWarning(const StudyResult& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const StudyWarning& warning) { return warning.code == code; });
}

TEST(Everyday, OrdinaryReachesAreKeptWithoutNewFlags) {
  const Judged judged = RunPlan(MakeEverydayPlan("ordinary"));
  Print("ordinary", judged);
  const Accuracy accuracy = CompareWithTruth(judged);
  EXPECT_GE(accuracy.num_kept, 17);
  EXPECT_LT(accuracy.sd, 0.006);
  EXPECT_GE(accuracy.coverage, 0.9);
  EXPECT_EQ(CountFlagged(judged.result, "regrasp"), 0);
  EXPECT_TRUE(judged.result.warnings.empty());
}

TEST(Everyday, ADigitThatLeavesAndReturnsIsLeftOutUnlessItIsAskedFor) {
  for (const bool has_shape : {true, false}) {
    StudyPlan plan = MakeEverydayPlan("regrasp");
    plan.has_shape = has_shape;
    plan.conditions.regrasping_digit = 2;
    EXPECT_GE(CountRemovals(RunPlan(plan).result)["regrasp"], 17);
    plan.settings = "removal: {regrasp: false}\n";
    const Judged judged = RunPlan(plan);
    Print("regrasp", judged);
    const int num_kept = judged.result.CountKept();
    EXPECT_GE(20 * CountFlagged(judged.result, "regrasp"), 19 * num_kept);
    for (size_t i = 0; i < judged.truth.size(); ++i) {
      const StudyTrial& trial = judged.result.trials[i];
      if (!trial.IsKept()) continue;
      const Regrasp& regrasp = trial.analysis->contacts[2].regrasp;
      if (!regrasp.IsFound()) continue;
      EXPECT_NEAR(regrasp.first_touch.time, judged.truth[i].touch_times[2], 0.05);
      EXPECT_NEAR(regrasp.release.time, judged.truth[i].release_times[2], 0.06);
      EXPECT_NEAR(regrasp.left_by, 9e-3, 1.5e-3);
      // GFT of first touches is another one than that of lasting touches.
      EXPECT_FALSE(trial.analysis->timing_first.gft == trial.analysis->timing.gft);
    }
  }
}

TEST(Everyday, AMarkerThatStaysOnTheTableRemovesTheTrialByName) {
  StudyPlan plan = MakeEverydayPlan("left behind");
  plan.conditions.is_object_left_behind = true;
  const Judged judged = RunPlan(plan);
  Print("left behind", judged);
  EXPECT_EQ(judged.result.CountKept(), 0);
  EXPECT_GE(CountRemovals(judged.result)["object_left_behind"], 17);
  plan.make_reach = MakePushedReach;
  const Judged pushed = RunPlan(plan);
  Print("left behind, pushed", pushed);
  EXPECT_GE(CountRemovals(pushed.result)["object_left_behind"], 17);
}

TEST(Everyday, ThumbAndIndexExchangedAreReported) {
  StudyPlan plan = MakeEverydayPlan("exchanged");
  plan.conditions.is_swapped = true;
  const Judged judged = RunPlan(plan);
  Print("exchanged", judged);
  EXPECT_GE(CountRemovals(judged.result)["thumb_not_opposed"], 17);
}

// Of each person: one trial throughout, one for 20 ms of the reach, one from before the touch on.
TEST(Everyday, SomeExchangedLabelsCostTheirTrialsAlone) {
  StudyPlan plan = MakeEverydayPlan("some exchanged");
  plan.make_reach = [](const Conditions& conditions, const std::string& id, int trial) {
    Reach reach = MakeEverydayReach(conditions, id, trial);
    const auto exchange = [&](double begin, double end) {
      for (size_t i = 0; i < reach.times.size(); ++i) {
        if (reach.times[i] < begin || reach.times[i] >= end) continue;
        std::swap(reach.digits[0][i], reach.digits[1][i]);
      }
    };
    if (trial == 1) exchange(-INFINITY, INFINITY);
    if (trial == 2) exchange(reach.widest - 0.1, reach.widest - 0.08);
    if (trial == 4) exchange(reach.touch_times[1] - 0.03, INFINITY);
    return reach;
  };
  const Judged judged = RunPlan(plan);
  Print("some exchanged", judged);
  std::map<std::string, int> removals = CountRemovals(judged.result);
  EXPECT_EQ(removals["labels_exchanged"], plan.num_people);
  EXPECT_EQ(removals["label_jump"], 2 * plan.num_people);
  EXPECT_GE(judged.result.CountKept(), plan.num_people * (plan.trials_per_person - 3) - 1);
  for (const StudyTrial& trial : judged.result.trials) {
    if (trial.removed_code != "labels_exchanged" && trial.removed_code != "label_jump") continue;
    EXPECT_NE(trial.removed.find("thumb"), std::string::npos);
    EXPECT_NE(trial.removed.find("index"), std::string::npos);
  }
}

TEST(Everyday, SpikesAreBridged) {
  StudyPlan plan = MakeEverydayPlan("spikes");
  plan.conditions.spike_share = 0.01;
  const Judged judged = RunPlan(plan);
  Print("spikes", judged);
  const Accuracy accuracy = CompareWithTruth(judged);
  EXPECT_GE(accuracy.num_kept, 15);
  EXPECT_TRUE(HasWarning(judged.result, "spikes"));
  const double share = double(judged.result.num_spikes) / double(judged.result.num_samples);
  EXPECT_NEAR(share, 0.01, 0.002);
}

TEST(Everyday, AHoverBelowTheLimitCarriesItsFlag) {
  StudyPlan plan = MakeEverydayPlan("hover");
  plan.conditions.hovering_digit = 3;
  plan.conditions.hover_gap = 3.5e-3;
  const Judged judged = RunPlan(plan);
  Print("hover", judged);
  int num_stated = 0;
  for (const StudyTrial& trial : judged.result.trials) {
    if (!trial.IsKept()) continue;
    num_stated += !trial.analysis->contacts[3].contact.IsFound() ||
                  FormatFlags(*trial.analysis).find("may hover") != std::string::npos;
  }
  EXPECT_GE(num_stated, judged.result.CountKept() - 1);
}

TEST(Everyday, WhatMovesBeforeTheOthersArrive) {
  const auto report = [&](const char* name, const auto& change) {
    StudyPlan plan = MakeEverydayPlan(name);
    change(plan.conditions);
    const Judged judged = RunPlan(plan);
    Print(name, judged);
    const Accuracy accuracy = CompareWithTruth(judged);
    EXPECT_GE(accuracy.coverage, 0.87) << name;  // 0.9 less three times its error by chance
    EXPECT_LE(accuracy.num_silent, accuracy.num_contacts / 20) << name;
  };
  report("push 15 mm", [](Conditions& c) { c.push = 15e-3; });
  report("turn 15 deg", [](Conditions& c) { c.turn = 0.26; });
  report("soft", [](Conditions& c) { c.min_touch_speed = 5e-3, c.max_touch_speed = 20e-3; });
  report("tremor", [](Conditions& c) { c.tremor = 0.4e-3; });
}

// Pads sink in when they touch and again when the grip is built up, by as much: the touch is the
// first, and what pads hide of it is stated.
TEST(Everyday, ATouchIsNotTheGripThatFollowsIt) {
  for (const bool has_shape : {true, false}) {
    StudyPlan plan = MakeEverydayPlan("pads");
    plan.make_reach = MakePushedReach;
    plan.has_shape = has_shape;
    plan.conditions.push = 5e-3;
    plan.conditions.pad_depth = 0.5e-3;
    const Judged judged = RunPlan(plan);
    Print("pads", judged);
    const Accuracy accuracy = CompareWithTruth(judged);
    EXPECT_GE(accuracy.num_kept, 15);
    EXPECT_GE(accuracy.coverage, 0.82);  // 0.9 less 2.5 times its error by chance
    EXPECT_LT(accuracy.sd, 0.012);
  }
}

TEST(Everyday, AFilteredExportIsReported) {
  for (const double cutoff : {6.0, 10.0}) {
    StudyPlan plan = MakeEverydayPlan("filtered");
    plan.conditions.low_pass_hz = cutoff;
    const Judged judged = RunPlan(plan);
    Print("filtered", judged);
    EXPECT_TRUE(HasWarning(judged.result, "filtered_export")) << cutoff;
    EXPECT_EQ(CountFlagged(judged.result, "filtered export"), judged.result.CountKept());
    for (const StudyTrial& trial : judged.result.trials) {
      ASSERT_TRUE(trial.analysis);
      EXPECT_NEAR(trial.analysis->low_pass, cutoff, 0.35 * cutoff) << trial.id;
    }
  }
}

TEST(Everyday, TwoRatesInOneStudyAreReported) {
  StudyPlan plan = MakeEverydayPlan("two rates");
  plan.other_rate = 100.0;
  EXPECT_TRUE(HasWarning(RunPlan(plan).result, "two_rates"));
}

// The threshold finds the hand when it has moved for some 60 ms; the start is where it left rest.
TEST(Everyday, TheStartOfTheMovementHasLittleBias) {
  StudyPlan plan = MakeEverydayPlan("start");
  plan.conditions.min_peak = 0.4;
  plan.conditions.max_peak = 0.6;
  const Judged judged = RunPlan(plan);
  double start = 0.0, onset = 0.0;
  for (size_t i = 0; i < judged.truth.size(); ++i) {
    const Movement& movement = judged.result.trials[i].analysis->movement;
    start += (movement.start.time - judged.truth[i].onset) / double(judged.truth.size());
    onset += (movement.onset.time - judged.truth[i].onset) / double(judged.truth.size());
  }
  std::printf("start %.1f ms late, onset %.1f ms\n", 1e3 * start, 1e3 * onset);
  EXPECT_GT(onset, 0.04);
  EXPECT_LT(std::abs(start), 0.015);
}

TEST(Everyday, AVaryingProfileMakesNobodySimultaneous) {
  const NamedPlan named = ListIndependentPeople()[1];
  EXPECT_LE(CountVerdicts(named.plan, 3).num_more, 1);
}

TEST(Everyday, ASharedDelayIsFound) {
  const NamedPlan named = ListCoordinatedPeople()[0];
  EXPECT_GE(CountVerdicts(named.plan, 3).num_more, 2);
}

}  // namespace
}  // namespace graspbench::protocol
