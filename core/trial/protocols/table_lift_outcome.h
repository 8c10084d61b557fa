#pragma once
/** @file
What a trial is called in the end, decided from a few observed facts. */

#include <string>
#include <vector>

#include "core/arm/arm_course.h"
#include "core/grasp/contact_timing.h"
#include "core/grasp/strategy.h"
#include "core/hand/hand.h"
#include "core/physics/world.h"
#include "core/trial/outcome.h"

namespace graspbench {

/** A trial as it stands after some step. */
struct TrialFacts {
  Phase phase = Phase::kPlacing;
  double time = 0.0;           ///< since the start [s]
  double time_in_phase = 0.0;  ///< [s]
  double lift_time = 0.0;      ///< planned length of the lift-off [s]
  double lift_distance = 0.0;  ///< by which the hand rises [m]

  std::string not_seen = {};      ///< why the camera did not find the object; empty: nobody asks
  std::string policy_fault = {};  ///< what the controller answered wrongly; empty: nothing
  ArmFault arm_fault = ArmFault::kNone;  ///< why the arm cannot carry the hand there
  std::string arm_reason = {};           ///< the same in words
  bool is_reachable = true;              ///< the placement reaches the object
  double start_gap = 0.0;         ///< of hand and object at the start; negative: inside it [m]
  StepReport report = {};         ///< of the last step
  double unconverged_time = 0.0;  ///< since the solver last converged [s]

  double closed_grip_force = 0.0;  ///< of the hand on the object at the start of lift-off [N]
  double last_touch = 0.0;         ///< time of the last touch by the hand [s]
  double displacement = 0.0;       ///< of the object along the table, from its start [m]
  double rise = 0.0;               ///< of the object's centre above its start [m]
  double relative_speed = 0.0;     ///< CalcSlipSpeed: of the object against the hand [m/s]

  double arm_force_limit = 0.0;   ///< [N]
  double arm_moment_limit = 0.0;  ///< [N m]
  /** Of a robot arm that carries the hand, nearest its torque's limit, which holds instead of both
  limits; null: there is none. */
  const ArmJoint* arm_joint = nullptr;

  // For FindOutcome alone.
  double contact_force_limit = 0.0;  ///< what drives and arm can give [N]
  double energy_residual = 0.0;      ///< energy of the trial without a cause [J]
  double extent = 0.0;       ///< height of the object, from its lowest to its highest point [m]
  double rest_extent = 0.0;  ///< the same at the start [m]
  std::vector<DigitContact> contacts;
};

/** A held object that moves no faster against the palm is steady. Proposed by graspbench [m/s] */
inline constexpr double kSteadySpeed = 0.005;

struct OutcomeReason {
  Outcome outcome = Outcome::kNotRun;
  std::string reason;  ///< one sentence for a person; empty for a success
};

/** Nothing that follows can change the outcome. */
bool IsDecided(const TrialFacts& facts);
/** The outcome if the trial ends here: after the hold, once it is decided, or when the hand is to
be lifted without touching the object. */
OutcomeReason FindOutcome(const TrialFacts& facts);
/** The largest normal force that the hand's drives and the arm can put on one contact [N]: a
drive's torque acts at 10 mm or more from its axis, the thickness of a phalanx; what acts along a
finger is borne by the arm. More can only come from bodies inside each other. */
double CalcContactForceLimit(const Hand& hand, double arm_force_limit);
/** The object hangs in the hand, off the table. */
bool IsHeld(const TrialFacts& facts);

}  // namespace graspbench
