#pragma once
/** @file
The five-phase grasp strategy as a serial state machine (Roethling 2007, chapter 3):

    1 pre-grasp       the hand is at distance d and takes the pre-grasp posture
    2 placing         it moves to the grasp position
    3 closure         after its arrival it closes towards the target posture; ends at the first
                      instant at which all grasping digits touch
    4 stabilisation   until the grip is steady, or its maximum time has passed
    5 lift-off        back to the pre-grasp position, with or without the object

followed by a hold, in which the outcome is judged. The machine knows time and touch, but no
physics: the same one can drive a simulation or a replay. Closing is linear in the joint angles,

    q(s) = q_pre + s (q_target - q_pre),

and continues after the first touch until s = 1: the motion that the object prevents becomes force.
That is the grip "posture". Under "force" and "margin" each digit closes until it reaches its force
setpoint, which is then held (core/trial/grip). */

#include <optional>
#include <string>

#include "core/base/enum_table.h"

namespace graspbench {

enum class Phase { kPreGrasp, kPlacing, kClosure, kStabilisation, kLiftOff, kHold, kDone };
struct PhaseRow {
  Phase value;
  const char* name;
};
inline constexpr PhaseRow kPhases[] = {
    {Phase::kPreGrasp, "pre-grasp"}, {Phase::kPlacing, "placing"},
    {Phase::kClosure, "closure"},    {Phase::kStabilisation, "stabilisation"},
    {Phase::kLiftOff, "lift-off"},   {Phase::kHold, "hold"},
    {Phase::kDone, "done"}};
inline const char* NameOf(Phase phase) { return RowOf(kPhases, phase).name; }

/** What ends the closing of a digit. */
enum class GripMode {
  kPosture,  ///< its target posture: the force results from posture and stiffness
  kForce,    ///< its force setpoint
  kMargin    ///< a multiple of the smallest force with which the contacts bear the weight
};
struct GripModeRow {
  GripMode value;
  const char* name;  ///< in files
};
inline constexpr GripModeRow kGripModes[] = {
    {GripMode::kPosture, "posture"}, {GripMode::kForce, "force"}, {GripMode::kMargin, "margin"}};

/** How a digit's drives hold a regulated force. */
enum class DriveLaw {
  kHold,       ///< at a position, with their stiffness
  kSaturating  ///< at a torque limit, without restoring stiffness, as at constant pressure
};
struct DriveLawRow {
  DriveLaw value;
  const char* name;  ///< in files
};
inline constexpr DriveLawRow kDriveLaws[] = {{DriveLaw::kHold, "hold"},
                                             {DriveLaw::kSaturating, "saturating"}};

/** Times of the phases, and the grip. Proposed by graspbench: the thesis names the phases but gives
no times. */
struct StrategyConfig {
  double placing_time = 0.8;            ///< [s]
  double closure_time = 1.0;            ///< from pre-grasp to target without contact [s]
  double closure_patience = 0.3;        ///< after s = 1, wait this long for missing digits [s]
  double stabilisation_min_time = 0.5;  ///< sigma is computed over its last 0.5 s [s]
  double stabilisation_max_time = 2.0;  ///< counted from the end of closing of a regulated grip [s]
  double lift_time = 1.0;               ///< [s]
  double hold_time = 2.0;               ///< [s]
  double closure_lead = 0.0;            ///< closure begins this long before the arrival [s]
  std::string grip = "posture";         ///< one of kGripModes
  /** Setpoint of each digit that does not oppose the others; under "margin" the minimum [N]. */
  double grip_force = 0.7;
  double grip_margin = 2.0;        ///< multiple of the smallest force that bears the weight
  double touch_speed = 1.0;        ///< speed of a digit after its first touch, share of that before
  std::string drive_law = "hold";  ///< one of kDriveLaws

  template <class V>
  void Visit(V&& v) {
    v("placing_time_s", placing_time,
      {"time in which the open hand moves to the object", 0.05, 60});
    v("closure_time_s", closure_time,
      {"time of closing from pre-grasp to target posture without contact", 0.05, 60});
    v("closure_patience_s", closure_patience,
      {"time at the target posture during which digits without contact are awaited", 0, 60});
    v("stabilisation_min_time_s", stabilisation_min_time,
      {"minimum time of stabilisation before the lift", 0, 60});
    v("stabilisation_max_time_s", stabilisation_max_time,
      {"maximum time of stabilisation before the lift; with a regulated grip, after its digits "
       "have closed",
       0, 60});
    v("lift_time_s", lift_time, {"duration of the lift", 0.05, 60});
    v("hold_time_s", hold_time, {"time for which the object must be held after the lift", 0, 60});
    v("closure_lead_s", closure_lead,
      {"time by which closure begins before the hand arrives", 0, 60});
    v("grip", grip,
      "what ends the closing of a digit: posture (its target), force (grip_force_n) or margin "
      "(grip_margin)");
    v("grip_force_n", grip_force,
      {"force setpoint of each digit that does not oppose the others; with strategy.grip=margin "
       "the minimum setpoint; 0: no minimum",
       0, 1000});
    v("grip_margin", grip_margin,
      {"safety factor of the grip: multiple of the smallest forces with which the contacts bear "
       "the weight; object weight and friction are given to the controller",
       1, 100});
    v("touch_speed", touch_speed,
      {"closing speed of a digit after its first contact, share of its speed before", 0.01, 1});
    v("drive_law", drive_law,
      "how drives hold a regulated force: hold (a position, with their stiffness) or saturating (a "
      "limit of their torque, without)");
  }
};

/** What the machine observes in each step. */
struct StrategyObservation {
  bool all_digits_touched = false;  ///< every grasping digit has touched the object at least once
  double grip_force = 0.0;          ///< sum of the hand's normal forces on the object [N]
  /** State of a regulated grip: `is_in_band`: its force has stayed in its band for a while;
  `is_closing`: digits still close towards their setpoints. */
  bool is_regulated = false, is_in_band = false, is_closing = false;
  /** Whether a controller commands the lift; unset: there is no controller, the machine decides. */
  std::optional<bool> lifts = {};
};

/** The command to the hand at the end of the step. */
struct StrategyCommand {
  double closing = 0.0;   ///< s in [0, 1]
  double distance = 0.0;  ///< from the grasp position: backwards along the approach until the end
                          ///< of stabilisation, straight up from lift-off on [m]
  double speed = 0.0;     ///< d distance / dt [m/s]
};

class GraspStrategy {
 public:
  /** @param distance  d, at which the hand starts and to which it returns [m]. */
  GraspStrategy(const StrategyConfig& config, double distance);

  /** Sets the earliest time from the start of closure to s = 1 of the slowest digit [s]. */
  void SetClosureTime(double time) { slowest_closure_ = time; }

  /** Starts in the placing phase, `time_before_arrival` before the hand arrives. Nothing can touch
  before that, so nothing needs to be simulated. */
  void StartPlacing(double time_before_arrival);

  /** Advances by one step. */
  StrategyCommand Step(double step, const StrategyObservation& observation);

  Phase phase() const { return phase_; }
  double time_in_phase() const { return time_in_phase_; }

  /** The hand's distance `time_before_arrival` before the end of placing [m]. */
  double CalcPlacingDistance(double time_before_arrival) const;

 private:
  void Enter(Phase phase);

  bool IsSteady(const StrategyObservation& observation);

  StrategyConfig config_;
  double distance_;
  double slowest_closure_;
  Phase phase_ = Phase::kPreGrasp;
  double time_in_phase_ = 0.0;
  double closing_ = 0.0;
  double closed_since_ = 0.0;   ///< time in phase at which the digits had closed
  double settled_since_ = 0.0;  ///< time in phase at which the grip force last changed
  double settled_force_ = 0.0;  ///< [N]
};

}  // namespace graspbench
