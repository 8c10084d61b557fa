#pragma once
/** @file
A hand, an object and a table in time.

One step of length h goes from (q, u) to (q + h (u + v) / 2, v):
1. positions move by h u / 2 to the middle of the step (the object turns by its rotation vector);
2. mass matrix, bias and contacts are taken there;
3. the implicit solve gives the speeds v at the end (step_solver.h); the bias is that of the mean
   speeds (u + v) / 2, so that the smooth part is second order and keeps its energy;
4. positions move by h v / 2.

Drives act by the command, the angle and the speed of the step's end, so that a finger lags behind
a ramp by damping over stiffness whatever the step. Contacts and limits look farther ahead, from the
middle by the whole of h v, which makes stiff springs settle in one step instead of ringing.

The hand's root moves as the strategy says; its motion is prescribed, whatever force that takes.

Another backend moves the same scene by other means: it overrides the virtual functions and keeps
`state_` up to date, so that the whole course of a trial runs on it unchanged. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/physics/collider.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/sim_config.h"
#include "core/physics/step_solver.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct WorldState {
  Pose X_WH = Pose::Identity();
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();  ///< of the prescribed root [m/s]
  Eigen::VectorXd q;                               ///< (num_joints) [rad]
  Eigen::VectorXd u;                               ///< (num_dofs) [rad/s]
  Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WOcm = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WO = Eigen::Vector3d::Zero();                            ///< [rad/s]
  Eigen::Vector3d v_WOcm = Eigen::Vector3d::Zero();                          ///< [m/s]
  Eigen::Vector3d gravity_W = Eigen::Vector3d(0.0, 0.0, -kStandardGravity);  ///< [m/s^2]
};

/** X_W<palm>: the palm's, which a wrist may turn against H. */
Pose CalcPalmPose(const Hand& hand, const WorldState& state);

/** What the hand is asked for at the end of a step. */
struct WorldCommand {
  Eigen::VectorXd q;             ///< drive commands (num_joints) [rad]
  Pose X_WH = Pose::Identity();  ///< rotation must not change
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();
};

/** What happened in a step. Forces are those of its end. */
struct StepReport {
  bool is_finite = true;
  bool converged = true;
  double grip_force = 0.0;                ///< sum of normal forces of the hand on the object [N]
  double table_force = 0.0;               ///< normal force of the table on the object [N]
  double worst_penetration = 0.0;         ///< deepest point of the hand in the object [m]
  std::vector<bool> link_touches_object;  ///< (num_links)
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
  bool is_sliding = false;      ///< friction is at its limit
  double mu = 0.0;              ///< of that state: static or dynamic
  double torsion_radius = 0.0;  ///< a pad resists spin up to mu * normal_force * this [m]
};

/** Energy account in the frame that moves with the hand's root [J]. Were the integration exact,
kinetic_energy - start = drives + gravity + contacts + limits + external; the rest is the residual.
*/
struct EnergyAccount {
  double drives = 0.0;    ///< work of the drives on the joints
  double limits = 0.0;    ///< work of the joint limits and of the stops of coupled joints
  double gravity = 0.0;   ///< work of gravity and of the moving frame's inertial force
  double contacts = 0.0;  ///< work of the contacts on hand and object; minus what they dissipate
  double external = 0.0;  ///< work of the external load on the object
  double kinetic_at_start = 0.0;
};

class World {
 public:
  World(const Hand& hand, const GraspObject& object, const SimConfig& config);
  virtual ~World() = default;

  /** Starts anew, without contacts or history. */
  virtual void Reset(const WorldState& state);

  virtual StepReport Step(const WorldCommand& command);

  /** Turns gravity, as a test or a verdict asks [m/s^2]. */
  void SetGravity(const Eigen::Vector3d& gravity_W) { state_.gravity_W = gravity_W; }

  /** A load on the object until it is changed; Reset takes it away.
  @param force_W  at the centre of mass [N]   @param moment_W  [N m] */
  void SetExternalLoad(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W) {
    external_force_W_ = force_W;
    external_moment_W_ = moment_W;
  }

  /** The contacts of the last step in the collider's fixed order, with the forces of the step's end
  at the places of its middle; replaces what is in `contacts`. */
  virtual void FindHandContacts(std::vector<HandContact>& contacts) const;

  const WorldState& state() const { return state_; }
  Pose CalcObjectPose() const;  ///< X_WO
  const EnergyAccount& energy() const { return energy_; }
  double CalcKineticEnergy();           ///< relative to the moving root [J]
  virtual double CalcEnergyResidual();  ///< [J]
  const MassProperties& mass_properties() const { return mass_; }  ///< of the object
  const Collider& collider() const { return collider_; }
  HandDynamics& dynamics() { return dynamics_; }

 protected:
  /** Decides which joint of each coupled pair moves in this step: it has a rate, the other none. */
  void ChooseDistalModes(const WorldCommand& command);

  const Hand* hand_;
  MassProperties mass_;
  HandDynamics dynamics_;
  WorldState state_;
  /** Links that keep their finger's middle joint from closing: they touched the object and have not
  been Collider::kMargin away from it since. */
  std::vector<bool> link_blocks_;

 private:
  void SetDistalRates(int dof);
  void MovePositions(double h, const Eigen::VectorXd& u, WorldState& state) const;
  void AddDrivesAndLimits(const WorldCommand& command);
  double CalcBias(const Eigen::VectorXd& mean_speeds, const Eigen::Vector3d& v_WH,
                  const Eigen::Vector3d& lift_W, Eigen::VectorXd& bias) const;
  void AccountEnergy(const Eigen::VectorXd& v, const Eigen::Vector3d& mean_v_WH, double power);
  StepReport MakeReport(const Eigen::VectorXd& v, bool converged) const;
  void UpdateBlocks(const std::vector<bool>& link_touches_object);

  SimConfig config_;
  Collider collider_;
  StepSolver solver_;
  StepProblem problem_;
  WorldState middle_;              // of the current step
  Eigen::VectorXd v_;              // speeds at the end of the last step: [hand dofs, w, v]
  std::vector<DistalMode> modes_;  // by dof
  Eigen::Vector3d external_force_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d external_moment_W_ = Eigen::Vector3d::Zero();
  int num_drives_ = 0;  // the first entries of problem_.scalars
  int step_number_ = 0;
  EnergyAccount energy_;
};

}  // namespace graspbench
