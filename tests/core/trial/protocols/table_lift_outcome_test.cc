#include "core/trial/protocols/table_lift_outcome.h"

#include <gtest/gtest.h>

#include <functional>

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
  facts.report.grip_force = facts.closed_grip_force = 3.0;
  facts.extent = facts.rest_extent = 0.03;
  facts.arm_force_limit = facts.arm_moment_limit = facts.contact_force_limit = 100.0;
  facts.contacts = {{"FF", false, 0.5}, {"TH", true, 0.6}};
  return facts;
}

/** The object lies where it was; the hand came back empty. */
TrialFacts MakeEmptyEnd() {
  TrialFacts facts = MakeGoodEnd();
  facts.rise = 0.0;
  facts.report.grip_force = 0.0;
  facts.report.table_force = 0.1;
  facts.last_touch = 1.0;
  return facts;
}

struct Case {
  Outcome outcome;
  const char* reason;
  std::function<void(TrialFacts&)> change;
};
void ExpectOutcomes(const TrialFacts& begin, const std::vector<Case>& cases) {
  for (const Case& one : cases) {
    TrialFacts facts = begin;
    one.change(facts);
    const OutcomeReason found = FindOutcome(facts);
    EXPECT_EQ(found.outcome, one.outcome) << NameOf(found.outcome);
    EXPECT_EQ(found.reason, one.reason);
  }
}

// Success needs a held and steady object, and nothing that no real hand could do.
TEST(TrialOutcome, OfAnObjectThatIsUp) {
  ExpectOutcomes(
      MakeGoodEnd(),
      {{Outcome::kSuccess, "", [](auto&) {}},
       {Outcome::kSuccess, "",
        [](auto& f) {
          f.report.worst_penetration = 0.00099;
          f.report.worst_contact_force = 99.0;
          f.energy_residual = -0.00099;
        }},
       {Outcome::kDroppedWhileHolding,
        "still moving in the hand at 6.2 mm/s at the end of the hold",
        [](auto& f) { f.relative_speed = 0.0062; }},
       {Outcome::kNumericalFailure, "positions or speeds became infinite 4.000 s into the trial",
        [](auto& f) { f.report.is_finite = false; }},
       {Outcome::kNumericalFailure,
        "the solver did not converge for 0.11 s, up to 4.000 s into the trial",
        [](auto& f) { f.unconverged_time = 0.11; }},
       {Outcome::kSlippedInLiftOff,
        "gripped with 3.00 N in all, but it hangs in the hand 90 mm up and still touches the table",
        [](auto& f) {
          f.rise = 0.09;
          f.report.table_force = 0.1;
        }},
       {Outcome::kKnockedOver,
        "the object tilted and hangs in the hand 90 mm up and still touches the table",
        [](auto& f) {
          f.rise = 0.09;
          f.report.table_force = 0.1;
          f.extent = 0.05;
        }},
       {Outcome::kNotPhysical, "-1.10 mJ of energy have no cause (limit 1 mJ)",
        [](auto& f) { f.energy_residual = -0.0011; }},
       {Outcome::kNotPhysical, "one contact presses with 2000 N; drives and arm can give 100 N",
        [](auto& f) { f.report.worst_contact_force = 2000.0; }},
       {Outcome::kNotPhysical, "the hand is 1.20 mm inside the object (limit 1 mm)",
        [](auto& f) { f.report.worst_penetration = 0.0012; }}});
}

TEST(TrialOutcome, OfAnObjectThatStayedBehind) {
  ExpectOutcomes(
      MakeEmptyEnd(),
      {{Outcome::kSlippedInLiftOff, "gripped with 3.00 N in all, but it stayed behind",
        [](auto&) {}},
       {Outcome::kLostWhileClosing, "all digits had touched, but none did before lift-off",
        [](auto& f) { f.closed_grip_force = 0.0; }},
       {Outcome::kPushedAway, "the object was pushed 60 mm aside and stayed behind",
        [](auto& f) { f.displacement = 0.06; }},
       {Outcome::kNoContact, "not touched while closing by FF",
        [](auto& f) {
          f.displacement = 0.06;
          f.contacts[0].time = kUnset;
        }},
       {Outcome::kKnockedOver, "the object tipped over and stayed behind",
        [](auto& f) { f.extent = 0.05; }},
       {Outcome::kDroppedWhileHolding, "fell out of the hand 0.40 s into the hold", [](auto& f) {
          f.phase = Phase::kHold;
          f.time_in_phase = 0.4;
          f.last_touch = f.time - 0.2;
        }}});
}

// Each of these is decided at once.
TEST(TrialOutcome, OfATrialThatCannotGoOn) {
  TrialFacts begin = MakeGoodEnd();
  begin.phase = Phase::kClosure;
  EXPECT_FALSE(IsDecided(begin));
  const std::vector<Case> cases = {
      {Outcome::kArmOverloaded,
       "the arm bore 101 N and 0.0 N m in addition to the hand's weight (limits 100 N, 100.0 N m)",
       [](auto& f) { f.report.arm_force = 101.0; }},
      {Outcome::kArmOverloaded,
       "the arm bore 0 N and 101.0 N m in addition to the hand's weight (limits 100 N, 100.0 N m)",
       [](auto& f) { f.report.arm_moment = 101.0; }},
      {Outcome::kUnreachable,
       "the palm or another link would meet the object before the fingertips hold it",
       [](auto& f) { f.is_reachable = false; }},
      {Outcome::kUnreachable, "the hand would start 1.2 mm inside the object",
       [](auto& f) { f.start_gap = -0.0012; }},
      {Outcome::kArmOutOfReach, "too far",
       [](auto& f) {
         f.arm_fault = ArmFault::kOutOfReach;
         f.arm_reason = "too far";
       }},
      {Outcome::kNoStraightPath, "blocked",
       [](auto& f) {
         f.arm_fault = ArmFault::kNoStraightPath;
         f.arm_reason = "blocked";
       }},
      {Outcome::kNearSingularity, "too fast",
       [](auto& f) {
         f.arm_fault = ArmFault::kNearSingularity;
         f.arm_reason = "too fast";
       }},
      {Outcome::kNotSeen, "nothing is seen", [](auto& f) {
         f.not_seen = "nothing is seen";
         f.is_reachable = false;
       }}};
  ExpectOutcomes(begin, cases);
  for (const Case& one : cases) {
    TrialFacts facts = begin;
    one.change(facts);
    EXPECT_TRUE(IsDecided(facts)) << one.reason;
  }
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
  EXPECT_EQ(FindOutcome(facts).reason, "the object was pushed 60 mm aside before it was held");
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
  facts.report.is_finite = false;
  EXPECT_TRUE(IsDecided(facts));
}

}  // namespace
}  // namespace graspbench
