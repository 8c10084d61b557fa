#pragma once
/** @file
A hand, an object and, where there is one, a table in time: what every backend shows to a trial.
The default backend is ImplicitWorld (implicit_world.h); another moves the same scene by other
means (compliant_world.h), and the whole course of a trial runs on it unchanged.

The hand's base follows the commanded motion as its backend's arm does. A world refers to its hand
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
  /** Part of q by which a joint has left its coupling (num_joints); empty at a start: none [rad]. */
  Eigen::VectorXd deviation;
  /** That carries the hand, and outlives the world; null: the springs of SimConfig. Its posture then
  decides X_WH and its speeds w_WH and v_WH. A backend without (compliant_world.h) has the springs.
  */
  const MountedArm* arm = nullptr;
  Eigen::VectorXd q_arm, u_arm;  ///< of its joints [rad], [rad/s]
  Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WOcm = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WO = Eigen::Vector3d::Zero();                            ///< [rad/s]
  Eigen::Vector3d v_WOcm = Eigen::Vector3d::Zero();                          ///< [m/s]
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0.0, 0.0, -kStandardGravity);  ///< [m/s^2]
};

/** At rest in this posture. */
void SetArm(const MountedArm& arm, const Eigen::VectorXd& q, WorldState& state);

/** X_W<palm>: the palm's, which a wrist may turn against H. */
Pose CalcPalmPose(const Hand& hand, const WorldState& state);

/** The coordinate that a joint's drive acts on: its position, and that of the joint which follows it
where the middle joint moves first (CouplingRule::kMiddleFirst).
@param joint  index into Hand::joints.   @returns [rad], of a prismatic joint [m]. */
double CalcDrivePosition(const Hand& hand, const WorldState& state, int joint);

/** What the hand is asked for at the end of a step. */
struct WorldCommand {
  Eigen::VectorXd q;  ///< drive commands (num_joints) [rad]
  Pose X_WH = Pose::Identity();
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();
  /** Where the commanded pose turns [rad/s]; a backend without (compliant_world.h) takes a rotation
  that does not change. */
  Eigen::Vector3d w_WH = Eigen::Vector3d::Zero();
  /** Of the drives, where below their own (num_joints) [N m]; empty: their own. */
  Eigen::VectorXd torque_limit = {};
  /** Of the drives, as a share of their own (num_joints), at least 0; empty: their own. A backend
  without (compliant_world.h) takes their own. */
  Eigen::VectorXd stiffness = {};
  int num_steps = 1;  ///< of the settings' length that are taken as one
  /** Of a robot arm's joints [rad], [rad/s], whose posture X_WH and its speeds are then; empty: the
  arm finds the posture for X_WH. */
  Eigen::VectorXd q_arm = {}, u_arm = {};
};

/** What happened in a step. Forces are those of its end. */
struct StepReport {
  bool is_finite = true;
  bool converged = true;
  double grip_force = 0.0;           ///< sum of normal forces of the hand on the object [N]
  double table_force = 0.0;          ///< normal force of the table on the object [N]
  double worst_penetration = 0.0;    ///< deepest point of the hand in the object beyond the
                                     ///< depth of its pad and, of a compressible one, of
                                     ///< its surface under the force [m]
  double worst_contact_force = 0.0;  ///< largest normal force of one hand contact [N]
  double arm_force = 0.0;            ///< that the arm bears beside the hand itself [N]
  double arm_moment = 0.0;           ///< the same about H's origin [N m]
  int arm_joint = -1;             ///< of a robot arm, whose torque is nearest its limit; -1: no arm
  double arm_torque_share = 0.0;  ///< that torque over its limit, with the weights it holds
  bool is_followed = true;        ///< the robot arm has a posture for the commanded pose
  std::vector<bool> link_touches_object;  ///< (num_links)
  /** Time since a link that touches met the object within this step, at most the step, by the speed
  of approach at its start (num_links) [s]; empty where the backend does not look into its steps. */
  std::vector<double> touch_age;
};

/** A point where the hand presses on the object. */
struct HandContact {
  int link = -1;
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Vector3d nhat_W = Eigen::Vector3d::Zero();      ///< unit, from the hand into the object
  double normal_force = 0.0;                             ///< > 0 [N]
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();  ///< tangential force on the object [N]
  double spin_moment = 0.0;     ///< on the object about nhat_W; pads only [N m]
  double slip_speed = 0.0;      ///< tangential speed of the surfaces [m/s]
  bool is_at_limit = false;     ///< friction or torsion is; it may stand still all the same
  double mu = 0.0;              ///< of that state: static or dynamic
  double mu_dynamic = 0.0;      ///< once it slides
  double torsion_radius = 0.0;  ///< a pad resists spin up to mu * normal_force * this [m]
};

/** Slower than this a contact stands still, also at its limit [m/s]. */
inline constexpr double kSlipSpeed = 1e-3;
/** Friction is at its limit and the surfaces move against each other. */
inline bool IsSliding(const HandContact& contact) {
  return contact.is_at_limit && contact.slip_speed > kSlipSpeed;
}
/** "sticks", "at its limit" or "slides". */
const char* DescribeState(const HandContact& contact);

/** Share of the friction cone that the tangential force uses, 1 at its limit; NaN without a cone.
Torsion is not counted. */
double CalcConeShare(const HandContact& contact);

class World {
 public:
  virtual ~World() = default;
  World& operator=(const World&) = delete;

  /** A world of its own in the same instant, of the same hand and object: what is done to one does
  not reach the other. How far it goes on in the same way is said by each backend.
  @throws Error(kUnsupported) where the backend cannot. */
  virtual std::unique_ptr<World> Clone() const = 0;

  /** Starts again, without contacts, history or external load. */
  virtual void Reset(const WorldState& state) = 0;

  virtual StepReport Step(const WorldCommand& command) = 0;

  /** Turns gravity, as a test or a verdict asks [m/s^2].
  @throws Error(kUnsupported) where the backend cannot. */
  virtual void SetGravity(const Eigen::Vector3d& gravity_W) = 0;

  /** A load on the object until it is changed; Reset takes it away.
  @param force_W  at the centre of mass [N]   @param moment_W  [N m]
  @throws Error(kUnsupported) where the backend cannot. */
  virtual void SetExternalLoad(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W) = 0;

  /** The contacts of the last step in an order that the backend fixes; replaces what is in
  `contacts`. */
  virtual void FindHandContacts(std::vector<HandContact>& contacts) const = 0;

  /** Energy since Reset that nothing explains [J]; NaN where the backend keeps no account. */
  virtual double CalcEnergyResidual() = 0;

  const WorldState& state() const { return state_; }
  Pose CalcObjectPose() const;                                     ///< X_WO
  double CalcKineticEnergy();                                      ///< of hand and object [J]
  const MassProperties& mass_properties() const { return mass_; }  ///< of the object
  const Collider& collider() const { return collider_; }
  HandDynamics& dynamics() { return dynamics_; }
  Eigen::VectorXd CalcHandSpeeds() const;  ///< [u, w_WH, v_WH], as HandDynamics has them

 protected:
  World(const Hand& hand, const GraspObject& object, const SimConfig& config, TablePresence table);
  World(const World&) = default;

  /** Adds the drives' armatures to the hand's mass matrix (num_speeds x num_speeds at least). */
  void AddArmatures(Eigen::MatrixXd& M) const;

  /** What Reset does in every backend. */
  void ResetScene(const WorldState& state);

  /** Decides which joint of each coupled pair moves in this step: it has a rate, the other none.
  What moved hits its stop: adds the work of the stops [J], at most 0, to `stop_work`. */
  void ChooseDistalModes(const WorldCommand& command, double& stop_work);

  const Hand* hand_;
  MassProperties mass_;
  HandDynamics dynamics_;
  Collider collider_;
  WorldState state_;
  /** Links that keep their finger's middle joint from closing: they touched the object and have not
  been Collider::kMargin away from it since. */
  std::vector<bool> link_blocks_;

 private:
  void SetDistalRates(int dof);

  std::vector<DistalMode> modes_;  // by dof
};

/** A world held by value: a copy is a clone. */
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
