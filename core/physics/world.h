#pragma once
/** @file
A hand, an object and, optionally, a table over time: the interface of every physics backend. The
default backend is ImplicitWorld (implicit_world.h). Another one simulates the same scene by
different methods (compliant_world.h), and a whole trial runs on it unchanged.

The hand's base follows the commanded motion as the backend's arm does. A world refers to its hand
and object, which must outlive it, and belongs to one thread. */

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/physics/collider.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct MountedArm;

struct WorldState {
  Pose X_WH = Pose::Identity();
  Eigen::Vector3d w_WH = Eigen::Vector3d::Zero();  ///< of the hand's base [rad/s]
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();  ///< of H's origin [m/s]
  Eigen::VectorXd q;                               ///< (num_joints) [rad]
  Eigen::VectorXd u;                               ///< (num_dofs) [rad/s]
  /** Deviation of each joint from its coupling, included in q (num_joints) [rad]; empty at a start:
  none. */
  Eigen::VectorXd deviation;
  /** Robot arm that carries the hand; it must outlive the world. Null: the springs of SimConfig.
  The posture of the arm determines X_WH, and its speeds determine w_WH and v_WH. A backend without
  robot arms (compliant_world.h) uses the springs. */
  const MountedArm* arm = nullptr;
  Eigen::VectorXd q_arm, u_arm;  ///< of the arm's joints [rad], [rad/s]
  Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WOcm = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WO = Eigen::Vector3d::Zero();                            ///< [rad/s]
  Eigen::Vector3d v_WOcm = Eigen::Vector3d::Zero();                          ///< [m/s]
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0.0, 0.0, -kStandardGravity);  ///< [m/s^2]
};

/** Sets the arm at rest in this posture. */
void SetArm(const MountedArm& arm, const Eigen::VectorXd& q, WorldState& state);

/** Returns X_W<palm>, the pose of the palm, which a wrist may turn relative to H. */
Pose CalcPalmPose(const Hand& hand, const WorldState& state);

/** Returns the coordinate that a joint's drive acts on: its position, plus that of the joint that
follows it if the middle joint moves first (CouplingRule::kMiddleFirst).
@param joint  index into Hand::joints.   @returns [rad], for a prismatic joint [m]. */
double CalcDrivePosition(const Hand& hand, const WorldState& state, int joint);

/** Commands to the hand for the end of a step. */
struct WorldCommand {
  Eigen::VectorXd q;  ///< drive commands (num_joints) [rad]
  Pose X_WH = Pose::Identity();
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();
  /** Angular velocity of the commanded pose [rad/s]. A backend that does not use it
  (compliant_world.h) assumes a constant orientation. */
  Eigen::Vector3d w_WH = Eigen::Vector3d::Zero();
  /** Torque limits of the drives, where below their own (num_joints) [N m]; empty: their own. */
  Eigen::VectorXd torque_limit = {};
  /** Stiffnesses of the drives as shares of their own (num_joints), at least 0; empty: their own. A
  backend that does not support this (compliant_world.h) uses their own. */
  Eigen::VectorXd stiffness = {};
  int num_steps = 1;  ///< number of steps of the configured length that are taken as one
  /** Commanded posture and speeds of a robot arm's joints [rad], [rad/s]; X_WH and its speeds then
  match them. Empty: the arm finds the posture for X_WH. */
  Eigen::VectorXd q_arm = {}, u_arm = {};
};

/** Results of a step. Forces are those at its end. */
struct StepReport {
  bool is_finite = true;
  bool converged = true;
  double grip_force = 0.0;           ///< sum of normal forces of the hand on the object [N]
  double table_force = 0.0;          ///< normal force of the table on the object [N]
  double worst_penetration = 0.0;    ///< largest depth of the hand in the object, less the
                                     ///< depth of its pad and the yield of a compressible
                                     ///< object's surface [m]
  double worst_contact_force = 0.0;  ///< largest normal force of one hand contact [N]
  double arm_force = 0.0;            ///< on the arm, in addition to the hand itself [N]
  double arm_moment = 0.0;           ///< likewise, about H's origin [N m]
  int arm_joint = -1;                ///< robot arm's joint nearest its torque limit; -1: no arm
  double arm_torque_share = 0.0;     ///< ratio of that torque, weights included, to its limit
  bool is_followed = true;           ///< whether the robot arm has a posture for the commanded pose
  std::vector<bool> link_touches_object;  ///< (num_links)
  /** For each touching link, the time since it met the object within this step, at most the step,
  estimated from the approach speed at its start (num_links) [s]. Empty if the backend does not
  resolve times within a step. */
  std::vector<double> touch_age;
};

/** A point at which the hand presses on the object. */
struct HandContact {
  int link = -1;
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Vector3d nhat_W = Eigen::Vector3d::Zero();      ///< unit, from the hand into the object
  double normal_force = 0.0;                             ///< > 0 [N]
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< tangential force on the object [N]
  double spin_moment = 0.0;     ///< on the object about nhat_W; pads only [N m]
  double slip_speed = 0.0;      ///< tangential speed of the surfaces [m/s]
  bool is_at_limit = false;     ///< friction or torsion is at its limit; may be at rest
  double mu = 0.0;              ///< coefficient in this state: static or dynamic
  double mu_dynamic = 0.0;      ///< coefficient when sliding
  double torsion_radius = 0.0;  ///< a pad resists torsion up to mu * normal_force * this [m]
};

/** Below this speed a contact is at rest, even at its friction limit [m/s]. */
inline constexpr double kSlipSpeed = 1e-3;
/** Returns whether friction is at its limit and the surfaces move relative to each other. */
inline bool IsSliding(const HandContact& contact) {
  return contact.is_at_limit && contact.slip_speed > kSlipSpeed;
}
/** Returns "sticks", "at its limit" or "slides". */
const char* DescribeState(const HandContact& contact);

/** Returns the share of the friction cone that the tangential force uses: 1 at the limit, NaN
without friction. Torsion does not count. */
double CalcConeShare(const HandContact& contact);

class World {
 public:
  virtual ~World() = default;
  World& operator=(const World&) = delete;

  /** Returns an independent copy of the world in its current state, with the same hand and object.
  Each backend specifies how exactly the copy continues in the same way.
  @throws Error(kUnsupported) if the backend cannot clone. */
  virtual std::unique_ptr<World> Clone() const = 0;

  /** Restarts from `state`, without contacts, history or external load. */
  virtual void Reset(const WorldState& state) = 0;

  virtual StepReport Step(const WorldCommand& command) = 0;

  /** Changes gravity, for tests and for the evaluation of a grasp [m/s^2].
  @throws Error(kUnsupported) if the backend does not support it. */
  virtual void SetGravity(const Eigen::Vector3d& gravity_W) = 0;

  /** Applies a load to the object until it is changed; Reset removes it.
  @param force_W  at the centre of mass [N]   @param moment_W  [N m]
  @throws Error(kUnsupported) if the backend does not support it. */
  virtual void SetExternalLoad(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W) = 0;

  /** Returns the contacts of the last step in `contacts`, in an order that the backend defines. */
  virtual void FindHandContacts(std::vector<HandContact>& contacts) const = 0;

  /** Returns the unexplained change of energy since Reset [J]; NaN if the backend keeps no
  account. */
  virtual double CalcEnergyResidual() = 0;

  const WorldState& state() const { return state_; }
  Pose CalcObjectPose() const;                                     ///< X_WO
  double CalcKineticEnergy();                                      ///< of hand and object [J]
  const MassProperties& mass_properties() const { return mass_; }  ///< of the object
  const Collider& collider() const { return collider_; }
  HandDynamics& dynamics() { return dynamics_; }
  Eigen::VectorXd CalcHandSpeeds() const;  ///< [u, w_WH, v_WH], as in HandDynamics

 protected:
  World(const Hand& hand, const GraspObject& object, const SimConfig& config, TablePresence table);
  World(const World&) = default;

  /** Adds the drives' armatures to the hand's mass matrix (num_speeds x num_speeds at least). */
  void AddArmatures(Eigen::MatrixXd& M) const;

  /** The part of Reset that all backends share. */
  void ResetScene(const WorldState& state);

  /** Decides which joint of each coupled pair moves in this step and sets its rate; the other joint
  has rate 0. At a change the moving joint is stopped: the work of the stops [J], at most 0, is
  added to `stop_work`. */
  void ChooseDistalModes(const WorldCommand& command, double& stop_work);

  const Hand* hand_;
  MassProperties mass_;
  HandDynamics dynamics_;
  Collider collider_;
  WorldState state_;
  /** Links that block the middle joint of their finger from closing: they touched the object and
  have since been within Collider::kMargin of it. */
  std::vector<bool> link_blocks_;

 private:
  void SetDistalRates(int dof);

  std::vector<DistalMode> modes_;  // by dof
};

/** A world held by value: copying it clones it. */
class WorldCopy {
 public:
  explicit WorldCopy(const World& world) : world_(world.Clone()) {}
  WorldCopy(const WorldCopy& other) : WorldCopy(*other.world_) {}
  WorldCopy& operator=(const WorldCopy&) = delete;

  World& operator*() { return *world_; }
  const World& operator*() const { return *world_; }
  World* operator->() { return world_.get(); }
  const World* operator->() const { return world_.get(); }

 private:
  std::unique_ptr<World> world_;
};

}  // namespace graspbench
