#pragma once
/** @file
The setup of one grasp trial: a hand, an object, a grasp, settings, and the quantities that vary
between trials. */

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

/** What the hand knows of the object's pose before it is placed. */
enum class Positioning {
  kNominal,  ///< only the nominal pose
  kTrue,     ///< the exact pose
  kCamera    ///< the pose that its own camera finds (core/vision/wrist_camera.h)
};
inline constexpr NamedValue<Positioning> kPositionings[] = {{Positioning::kNominal, "nominal"},
                                                            {Positioning::kTrue, "true"},
                                                            {Positioning::kCamera, "camera"}};

/** Sampled initial pose (draw) of a trial. Draws depend on the trial's number and the object only,
so that every grasp and variant gets the same poses. */
struct TrialDraw {
  double offset_x = 0.0;        ///< of the object on the table [m]
  double offset_y = 0.0;        ///< [m]
  double offset_yaw = 0.0;      ///< [rad]
  Eigen::VectorXd joint_error;  ///< added to every drive's command (num_joints) [rad], [m]
};

/** From a given time on, replaces the strategy's setpoint of a joint's drive. */
struct DriveCommand {
  double time = 0.0;      ///< since the start [s]
  int joint = -1;         ///< index into Hand::joints, of a joint with its own drive
  double position = 0.0;  ///< [rad], [m] if prismatic
};

/** Which digit is delayed, by its first contact in the same trial without delay. */
enum class LateDigit { kNone, kFirst, kLast };

/** Choice of the camera among TrialSetup::sight_grasps. */
struct SightChoice {
  std::string grasp;   ///< id; empty: the object was not found
  std::string reason;  ///< why it was not found; becomes the reason of the outcome
};

struct TrialSetup {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  std::string protocol = "table_lift";  ///< id of the protocol (protocols/)
  Grasp grasp;
  /** The camera chooses `grasp` from these; until then `grasp` gives the pre-grasp posture for the
  image (ChooseGraspBySight). Empty: `grasp` is fixed. */
  std::vector<Grasp> sight_grasps = {};
  std::optional<SightChoice> sight = {};  ///< result of that choice; unset: `grasp` is fixed
  StrategyConfig strategy;
  SimConfig sim;
  TrialDraw draw;
  Positioning positioning = Positioning::kNominal;
  CameraConfig camera = {};
  std::shared_ptr<const MountedArm> arm = {};  ///< robot arm that carries the hand; null: none
  TouchSense touch = TouchSense::kExact;
  SensorConfig sensors = {};
  std::vector<DriveCommand> drives = {};        ///< manual commands, by time; none in a session
  std::vector<double> lateness = {};            ///< delay by digit of the hand [s]; empty: none
  LateDigit late = LateDigit::kNone;            ///< digit to be delayed, see digit_delays.h
  double delay = 0.0;                           ///< its delay [s]
  bool keeps_closing = false;                   ///< report TrialResult::closing
  bool finds_strength = false;                  ///< report TrialResult::strength
  PolicyConfig policy = {};                     ///< of policy_lift
  std::shared_ptr<HandPolicy> controller = {};  ///< of policy_lift; used by one thread only
  std::string trial_id = {};                    ///< sent to a controller
  unsigned policy_seed = 0;                     ///< likewise
  bool is_compliant = false;  ///< use the second world (core/physics/simbody/compliant_world.h)
};

}  // namespace graspbench
