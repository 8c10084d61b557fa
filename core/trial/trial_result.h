#pragma once
/** @file
What is known of a trial after it was carried out. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/grasp/contact_order.h"
#include "core/trial/contact_events.h"
#include "core/trial/outcome.h"
#include "core/trial/stability.h"

namespace graspbench {

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

}  // namespace graspbench
