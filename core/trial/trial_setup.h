#pragma once
/** @file
What one grasp trial is made of: a hand, an object, a grasp, settings, and what differs from trial
to trial. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/grasp/standard_grasp.h"
#include "core/grasp/strategy.h"
#include "core/hand/hand.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"
#include "core/trial/policy/policy_config.h"
#include "core/trial/touch_sensors.h"
#include "core/vision/camera_config.h"

namespace graspbench {

class HandPolicy;
struct MountedArm;

/** What the hand knows of where the object lies before it places itself. */
enum class Positioning {
  kNominal,  ///< nothing: it goes to where the object should be
  kTrue,     ///< the object's pose, exactly
  kCamera    ///< what its own camera finds (core/vision/wrist_camera.h)
};
inline constexpr NamedValue<Positioning> kPositionings[] = {{Positioning::kNominal, "nominal"},
                                                            {Positioning::kTrue, "true"},
                                                            {Positioning::kCamera, "camera"}};

/** What differs from trial to trial. The draws depend on the trial's number and the object only, so
that every grasp and variant meets the same poses. */
struct TrialDraw {
  double offset_x = 0.0;        ///< of the object on the table [m]
  double offset_y = 0.0;        ///< [m]
  double offset_yaw = 0.0;      ///< [rad]
  Eigen::VectorXd joint_error;  ///< added to every drive's command (num_joints) [rad], [m]
};

/** From a time on a joint's drive is asked for this instead of what the strategy asks. */
struct DriveCommand {
  double time = 0.0;      ///< since the start [s]
  int joint = -1;         ///< index into Hand::joints, of a joint with a drive of its own
  double position = 0.0;  ///< [rad], of a prismatic joint [m]
};

/** Which digit closes late, by first contact in the same trial without delay. */
enum class LateDigit { kNone, kFirst, kLast };

/** What the camera chose of TrialSetup::sight_grasps. */
struct SightChoice {
  std::string grasp;   ///< id; empty: the object was not found
  std::string reason;  ///< why it was not found; the trial ends with it
};

struct TrialSetup {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  std::string protocol = "table_lift";  ///< id of what happens in the trial (protocols/)
  Grasp grasp;
  /** Of these the camera chooses `grasp`, which until then is the one in whose pre-grasp posture it
  looks (ChooseGraspBySight); empty: `grasp` is given. */
  std::vector<Grasp> sight_grasps = {};
  std::optional<SightChoice> sight = {};  ///< that was made; unset: `grasp` is given
  StrategyConfig strategy;
  SimConfig sim;
  TrialDraw draw;
  Positioning positioning = Positioning::kNominal;
  CameraConfig camera = {};
  std::shared_ptr<const MountedArm> arm = {};  ///< that carries the hand; null: none
  TouchSense touch = TouchSense::kExact;
  SensorConfig sensors = {};
  std::vector<DriveCommand> drives = {};  ///< a person's, by time; none in a session
  std::vector<double> lateness = {};      ///< of each digit of the hand [s]; empty: none is late
  LateDigit late = LateDigit::kNone;      ///< see digit_delays.h, which is
  double delay = 0.0;                     ///< so much later [s]
  bool keeps_closing = false;             ///< the result says how far closing moved the object
  bool finds_strength = false;            ///< the result says what the grasp stands
  PolicyConfig policy = {};               ///< of policy_lift
  std::shared_ptr<HandPolicy> controller = {};  ///< of policy_lift; outlives no trial's thread
  std::string trial_id = {};                    ///< told to a controller
  unsigned policy_seed = 0;                     ///< likewise
  bool is_compliant = false;  ///< in the second world (core/physics/simbody/compliant_world.h)
};

}  // namespace graspbench
