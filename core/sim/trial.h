#pragma once
/** @file
One grasp trial: the five-phase strategy (core/grasp/strategy.h) carried out by a hand on an object
in physics, then a hold, after which the outcome is given. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/grasp/contact_order.h"
#include "core/grasp/standard_grasp.h"
#include "core/grasp/strategy.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/sim/contact_events.h"
#include "core/sim/judgement.h"
#include "core/sim/stability.h"

namespace graspbench {

/** Counts changes of the physics that change results. Part of every trial id, so that records of
different physics never meet under one id. */
inline constexpr int kPhysicsVersion = 5;

enum class Outcome {
  kNotRun,
  kSuccess,
  kNoContact,            ///< not all grasping digits ever touched
  kPushedAway,           ///< the object left the fingers' reach before or during closure
  kKnockedOver,          ///< it tipped over
  kLostWhileClosing,     ///< touched, but contact was lost again before lift-off
  kSlippedInLiftOff,     ///< it did not come along
  kDroppedWhileHolding,  ///< lifted, then lost, touching the table or still slipping at the end
  kNumericalFailure,     ///< the simulation gave up; `reason` says why
};
const char* NameOf(Outcome outcome);  ///< "success", "no contact", ...
/** All outcomes but kNotRun, in the order above. */
const std::vector<Outcome>& ListOutcomes();
Outcome OutcomeFromName(const std::string& name);

/** Settings of the physics; part of the frozen session configuration. */
struct SimConfig {
  double step = 0.002;             ///< [s]
  double contact_stiffness = 1e5;  ///< normal, per contact point [N/m]
  /** Hunt-Crossley d in f = k x (1 + d xdot) [s/m]. Proposed: what meets at 0.05 m/s parts with 0.6
  of that, as soft fingertips and things on a table do; metal balls have 0.1 to 0.5. */
  double contact_dissipation = 20.0;
  double tangential_stiffness = 1e5;   ///< bristle, per contact point [N/m]
  double table_friction_static = 0.4;  ///< object and fingers on the table
  double table_friction_dynamic = 0.35;

  template <class V>
  void Visit(V&& v) {
    v("step_s", step);
    v("contact_stiffness_n_per_m", contact_stiffness);
    v("contact_dissipation_s_per_m", contact_dissipation);
    v("tangential_stiffness_n_per_m", tangential_stiffness);
    v("table_friction_static", table_friction_static);
    v("table_friction_dynamic", table_friction_dynamic);
  }
};

/** What differs from trial to trial. The draws depend on the trial's number and the object only, so
that every grasp and variant meets the same poses. */
struct TrialDraw {
  double offset_x = 0.0;        ///< of the object on the table [m]
  double offset_y = 0.0;        ///< [m]
  double offset_yaw = 0.0;      ///< [rad]
  Eigen::VectorXd joint_error;  ///< added to every drive's command (num_joints) [rad]
};

struct TrialSetup {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  StandardGrasp grasp;
  StrategyConfig strategy;
  SimConfig sim;
  TrialDraw draw;
};

/** A posture of the whole scene, for pictures. */
struct SceneSnapshot {
  std::string name;   ///< "pregrasp", "closed", "lifted"
  double time = 0.0;  ///< since the start of placing [s]
  Pose X_WH = Pose::Identity();
  Pose X_WO = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints) [rad]
};

/** How a grasping digit met the object. */
struct DigitTouch {
  double closing = kUnset;       ///< s of the closing law at its first touch; NaN: never touched
  Eigen::VectorXd q;             ///< joints of the whole hand then (num_joints) [rad]; else empty
  double smallest_gap = kUnset;  ///< to the object up to lift-off, 0 after a touch [m]; NaN: no
                                 ///< closure
};

struct PhaseStart {
  std::string name;   ///< "placing", "closure", ...
  double time = 0.0;  ///< since the start of closure [s]
};

struct TrialResult {
  Outcome outcome = Outcome::kNotRun;
  std::string reason;                  ///< one sentence for a person; empty for a success
  std::vector<DigitContact> contacts;  ///< of the grasping digits; times since the start of closure
  std::vector<DigitTouch> touches;     ///< of the same digits
  ContactTiming timing;                ///< t0 = 0 = start of closure
  double lift_height = 0.0;            ///< of the object's centre at the end, above rest [m]
  double hold_slip = kUnset;           ///< motion relative to the palm during the hold [m]
  /** Motion in the palm's frame in the second half of the hold: of the centre of mass, plus the
  turn times the object's radius [m]; NaN: not held to the end. */
  double hold_creep = kUnset;
  double end_speed = 0.0;              ///< relative to the palm at the end [m/s]
  double grip_force = 0.0;             ///< sum of normal forces on the object before lift-off [N]
  double worst_penetration = 0.0;      ///< deepest finger contact of the whole trial [m]
  double steady_penetration = kUnset;  ///< deepest finger contact at the end of the hold [m]
  Stability stability;
  std::vector<PhaseStart> phases;            ///< those reached, in order
  std::vector<ContactEvent> contact_events;  ///< times since the start of closure
  double energy_residual = 0.0;              ///< unexplained energy of the whole trial [J]
  int num_steps = 0;
  int num_unconverged = 0;      ///< steps whose solve did not reach its tolerance
  double simulated_time = 0.0;  ///< [s]
  std::vector<SceneSnapshot> snapshots;
};

/** A first contact is known to the step of the physics in which it was seen: digits that touched in
the same step are tied. */
ContactOrder FindContactOrder(const TrialResult& result);

Json ToJson(const TrialResult& result);
TrialResult TrialResultFromJson(const Json& json);

struct JudgedTrial {
  TrialResult result;
  std::optional<Judgement> judgement;  ///< unset: nothing was in the hand at the end of the hold
};

/** Runs trials of one hand and object; builds the Simbody system once and resets it.
Not to be shared between threads. Never throws for what happens inside a trial. */
class TrialRunner {
 public:
  /** @throws Error(kUnsupported) for a hand with a longer chain of joints than the solver holds. */
  TrialRunner(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object);
  ~TrialRunner();
  /** @pre setup.hand and setup.object are those of the constructor. */
  TrialResult Run(const TrialSetup& setup);
  /** The same trial, and then the judge of what it holds (judge.h); some five times the cost. */
  JudgedTrial Judge(const TrialSetup& setup);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graspbench
