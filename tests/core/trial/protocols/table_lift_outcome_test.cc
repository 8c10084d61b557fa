#include "core/trial/protocols/table_lift_outcome.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace graspbench {
namespace {

/** The end of a hold that went well. */
TrialFacts MakeGoodEnd() {
  TrialFacts facts;
  facts.phase = Phase::kDone;
  facts.time = facts.last_touch = 4.0;
  facts.lift_time = 1.0;
  facts.lift_distance = facts.rise = 0.1;
  facts.grip_force = facts.closed_grip_force = 3.0;
  facts.extent = facts.rest_extent = 0.03;
  facts.arm_force_limit = facts.arm_moment_limit = facts.contact_force_limit = 100.0;
  facts.contacts = {{"FF", false, 0.5}, {"TH", true, 0.6}};
  return facts;
}

/** The object lies where it was; the hand came back empty. */
TrialFacts MakeEmptyEnd() {
  TrialFacts facts = MakeGoodEnd();
  facts.rise = 0.0;
  facts.grip_force = 0.0;
  facts.table_force = 0.1;
  facts.last_touch = 1.0;
  return facts;
}

void ExpectOutcome(const TrialFacts& facts, Outcome outcome, const std::string& reason) {
  const OutcomeReason found = FindOutcome(facts);
  EXPECT_EQ(found.outcome, outcome) << NameOf(found.outcome);
  EXPECT_EQ(found.reason, reason);
}

TEST(TrialOutcome, SuccessNeedsAHeldAndSteadyObject) {
  TrialFacts facts = MakeGoodEnd();
  EXPECT_TRUE(IsHeld(facts));
  ExpectOutcome(facts, Outcome::kSuccess, "");
  facts.relative_speed = 0.0062;
  ExpectOutcome(facts, Outcome::kDroppedWhileHolding,
                "still moving in the hand at 6.2 mm/s at the end of the hold");
  facts.table_force = 0.1;
  EXPECT_FALSE(IsHeld(facts));
}

TEST(TrialOutcome, EveryFailureHasItsName) {
  ExpectOutcome(MakeEmptyEnd(), Outcome::kSlippedInLiftOff,
                "gripped with 3.00 N in all, but it stayed behind");
  TrialFacts facts = MakeEmptyEnd();
  facts.closed_grip_force = 0.0;
  ExpectOutcome(facts, Outcome::kLostWhileClosing,
                "all digits had touched, but none did before lift-off");
  facts = MakeEmptyEnd();
  facts.displacement = 0.06;
  ExpectOutcome(facts, Outcome::kPushedAway, "the object was pushed 60 mm aside and stayed behind");
  facts.contacts[0].time = kUnset;
  ExpectOutcome(facts, Outcome::kNoContact, "never touched by FF");
  facts = MakeEmptyEnd();
  facts.extent = 0.05;
  ExpectOutcome(facts, Outcome::kKnockedOver, "the object tipped over and stayed behind");
  facts = MakeEmptyEnd();
  facts.phase = Phase::kHold;
  facts.time_in_phase = 0.4;
  facts.last_touch = facts.time - 0.2;
  ExpectOutcome(facts, Outcome::kDroppedWhileHolding, "fell out of the hand 0.40 s into the hold");
  facts = MakeGoodEnd();
  facts.is_finite = false;
  ExpectOutcome(facts, Outcome::kNumericalFailure,
                "positions or speeds became infinite 4.000 s into the trial");
  facts = MakeGoodEnd();
  facts.unconverged_time = 0.11;
  ExpectOutcome(facts, Outcome::kNumericalFailure,
                "the solver did not converge for 0.11 s, up to 4.000 s into the trial");
}

TEST(TrialOutcome, AnObjectThatHangsInTheHandDidNotStayBehind) {
  TrialFacts facts = MakeGoodEnd();
  facts.rise = 0.09;
  facts.table_force = 0.1;
  ExpectOutcome(facts, Outcome::kSlippedInLiftOff,
                "gripped with 3.00 N in all, but it hangs in the hand 90 mm up and still touches "
                "the table");
  facts.extent = 0.05;
  ExpectOutcome(facts, Outcome::kKnockedOver,
                "the object tilted and hangs in the hand 90 mm up and still touches the table");
}

TEST(TrialOutcome, WhatNoRealHandCouldDoIsNoSuccess) {
  TrialFacts facts = MakeGoodEnd();
  facts.penetration = 0.00099;
  facts.contact_force = 99.0;
  facts.energy_residual = -0.00099;
  ExpectOutcome(facts, Outcome::kSuccess, "");
  facts.energy_residual = -0.0011;
  ExpectOutcome(facts, Outcome::kNotPhysical, "-1.10 mJ of energy have no cause (limit 1 mJ)");
  facts.contact_force = 2000.0;
  ExpectOutcome(facts, Outcome::kNotPhysical,
                "one contact presses with 2000 N; drives and arm can give 100 N");
  facts.penetration = 0.0012;
  ExpectOutcome(facts, Outcome::kNotPhysical, "the hand is 1.20 mm inside the object (limit 1 mm)");
}

TEST(TrialOutcome, AnOverloadedArmEndsTheTrial) {
  TrialFacts facts = MakeGoodEnd();
  facts.phase = Phase::kClosure;
  facts.arm_force = 101.0;
  EXPECT_TRUE(IsDecided(facts));
  ExpectOutcome(
      facts, Outcome::kArmOverloaded,
      "the arm bore 101 N and 0.0 N m in addition to the hand's weight (limits 100 N, 100.0 N m)");
  facts.arm_force = 99.0;
  facts.arm_moment = 101.0;
  EXPECT_TRUE(IsDecided(facts));
  facts.arm_moment = 0.0;
  EXPECT_FALSE(IsDecided(facts));
}

TEST(TrialOutcome, AnObjectThatCannotBeReachedIsNotTried) {
  TrialFacts facts = MakeGoodEnd();
  facts.is_reachable = false;
  EXPECT_TRUE(IsDecided(facts));
  ExpectOutcome(facts, Outcome::kUnreachable,
                "the palm or another link would meet the object before the fingertips hold it");
  facts.is_reachable = true;
  facts.start_gap = -0.0012;
  EXPECT_TRUE(IsDecided(facts));
  ExpectOutcome(facts, Outcome::kUnreachable, "the hand would start 1.2 mm inside the object");
}

TEST(TrialOutcome, AnObjectThatIsNotSeenIsNotTried) {
  TrialFacts facts = MakeGoodEnd();
  facts.not_seen = "nothing is seen";
  facts.is_reachable = false;
  EXPECT_TRUE(IsDecided(facts));
  ExpectOutcome(facts, Outcome::kNotSeen, "nothing is seen");
}

// A drive of 2 N m at 10 mm, and the arm behind it.
TEST(TrialOutcome, AContactHasWhatDrivesAndArmCanGive) {
  Hand hand;
  hand.joints.resize(2);
  hand.joints[0].drive.torque_limit = 0.5;
  hand.joints[1].drive.torque_limit = 2.0;
  EXPECT_DOUBLE_EQ(CalcContactForceLimit(hand, 50.0), 250.0);
}

TEST(TrialOutcome, IsDecidedAsSoonAsNothingCanChangeIt) {
  TrialFacts facts = MakeEmptyEnd();
  facts.phase = Phase::kClosure;
  EXPECT_FALSE(IsDecided(facts));  // it may still be gripped
  facts.displacement = 0.06;
  EXPECT_TRUE(IsDecided(facts));
  ExpectOutcome(facts, Outcome::kPushedAway,
                "the object was pushed 60 mm aside before it was held");
  facts = MakeEmptyEnd();
  facts.phase = Phase::kLiftOff;
  facts.time_in_phase = 0.4;
  EXPECT_FALSE(IsDecided(facts));
  facts.time_in_phase = 0.6;
  EXPECT_TRUE(IsDecided(facts));
  facts = MakeGoodEnd();
  facts.phase = Phase::kHold;
  EXPECT_FALSE(IsDecided(facts));
  facts.last_touch = facts.time - 0.2;
  EXPECT_TRUE(IsDecided(facts));
  facts.phase = Phase::kClosure;
  facts.last_touch = facts.time;
  facts.is_finite = false;
  EXPECT_TRUE(IsDecided(facts));
}

}  // namespace
}  // namespace graspbench
