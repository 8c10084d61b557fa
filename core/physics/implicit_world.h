#pragma once
/** @file
The default backend: implicit contact on top of the hand's rigid-body dynamics.

One step of length h goes from (q, u) to (q + h (u + v) / 2, v):
1. Positions move by h u / 2 to the middle of the step (the object turns by its rotation vector).
2. Mass matrix, bias and contacts are computed there. The hand's mass matrix is reused until a
   joint, or the hand, has turned by kKeptAngle. Its velocity-dependent forces count above
   kFastSpeed.
3. The implicit solve gives the speeds v at the end (step_solver.h). The bias is taken at the mean
   speeds (u + v) / 2, so that the smooth part is second order and conserves its energy.
4. Positions move by h v / 2.

Drives act on the means of command and angle over the step (trapezoidal rule: an undamped drive
keeps oscillating, whatever its stiffness) and on the speed at its end. So a finger lags behind a
ramp by damping divided by stiffness, whatever the step. Contacts and limits look ahead from the
middle by the full h v, so that stiff springs settle in one step instead of ringing.

A part that rolls on the table under the normal force N is braked about the horizontal axis by a
moment of at most SimConfig::table_rolling_resistance N. Below kRollingRestSpeed this moment is
proportional to the speed, so that an object at rest stays at rest.

The hand is mounted on an arm: a six-dimensional spring-damper between the hand's base and its
commanded pose, with the force limits of the arm (SimConfig). The arm carries the hand itself: its
weight and its inertia along the commanded motion do not deflect the spring, so a hand that touches
nothing is at its commanded pose. The arm's own inertia is not modelled. If WorldState names a robot
arm, its joints replace this spring (carrying_arm.h).

If nothing moves and nothing that acts has changed, a step is not computed and returns the last
report.

A clone continues bit for bit: it copies the bristles of all contacts, the solver's starting speeds,
the blocked links, the drives' imperfections, loads and the energy account. */

#include <memory>
#include <optional>

#include "core/physics/carrying_arm.h"
#include "core/physics/imperfect_drive.h"
#include "core/physics/step_solver.h"
#include "core/physics/world.h"

namespace graspbench {

/** Rolling resistance is proportional to the speed below this [rad/s]. */
inline constexpr double kRollingRestSpeed = 1e-3;

/** Energy account [J]. With exact integration, kinetic energy - start = drives + arm + gravity +
contacts + limits + external; the difference is the residual. */
struct EnergyAccount {
  double drives = 0.0;    ///< work on the joints by drives, their friction and compliant couplings
  double arm = 0.0;       ///< work of the arm on the hand's base
  double limits = 0.0;    ///< work of the joint limits and of the stops of coupled joints
  double gravity = 0.0;   ///< work of gravity
  double contacts = 0.0;  ///< work of the contacts on hand and object: minus the dissipated energy
  double external = 0.0;  ///< work of the external load on the object
  double kinetic_at_start = 0.0;
};

/** Checks that every chain of joints fits into a ContactPoint (ContactPoint::kMaxChain).
@param num_base  number of speeds that move the hand's base: six, or the joints of a robot arm.
@throws Error(kUnsupported) for a hand with a longer chain. */
void DemandShortChains(const Hand& hand, int num_base = 6);

class ImplicitWorld : public World {
 public:
  ImplicitWorld(const Hand& hand, const GraspObject& object, const SimConfig& config,
                TablePresence table = TablePresence::kPresent);

  std::unique_ptr<World> Clone() const override;
  void Reset(const WorldState& state) override;
  StepReport Step(const WorldCommand& command) override;
  void SetGravity(const Eigen::Vector3d& gravity_W) override {
    state_.gravity_W = gravity_W;
    stands_ = false;
  }
  void SetExternalLoad(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W) override {
    external_force_W_ = force_W;
    external_moment_W_ = moment_W;
    stands_ = false;
  }
  /** Reports forces at the step's end and positions at its middle, in the collider's order. */
  void FindHandContacts(std::vector<HandContact>& contacts) const override;
  double CalcEnergyResidual() override;

  const EnergyAccount& energy() const { return energy_; }

 private:
  void MovePositions(double h, const Eigen::VectorXd& u, WorldState& state) const;
  /** Updates the hand's positions and the mass matrix at middle_. */
  void UpdateDynamics();
  /** Updates the hand's part of the mass matrix if positions have changed enough. */
  void UpdateHandMass();
  /** Returns whether the command equals the last one and does not move. */
  bool IsAsBefore(const WorldCommand& command) const;
  void AddDrives(const WorldCommand& command);
  /** Adds the forces of the arm on the base, one for each of its speeds. */
  void AddArm(const WorldCommand& command);
  /** Index of the first of the object's six speeds. */
  int object_dof() const { return dynamics_.num_dofs() + num_base_; }
  /** Returns the speeds of state_ in the order of the problem. */
  Eigen::VectorXd FindSpeeds() const;
  // With a robot arm, whose joint speeds replace the six of the base (carried_world.cc):
  void ResetArm();
  /** Converts speeds of the problem to the hand's speeds as in HandDynamics. */
  Eigen::VectorXd CalcHandPart(const Eigen::VectorXd& speeds) const;
  void CalcArmMasses();
  void ProjectContacts();
  void CalcArmBias(const Eigen::VectorXd& mean_speeds);
  void FinishArmForces(const Eigen::VectorXd& v, const Eigen::VectorXd& mean);
  void FinishArm();
  void ReportTorques(const Eigen::VectorXd& torques, StepReport& report) const;
  void AddLimits();
  void AddRollingResistance();
  void AddStops(int dof, double rate, double q, double lower, double upper, double stiffness);
  void CalcBias(const Eigen::VectorXd& mean_speeds, const Eigen::Vector3d& acceleration_W);
  /** Accounts for the work of all forces and updates the memory of contacts. */
  void FinishForces(const Eigen::VectorXd& v);
  double CalcTouchAge(const ContactPoint& contact) const;
  StepReport MakeReport(const Eigen::VectorXd& v, bool converged) const;
  void UpdateBlocks(const std::vector<bool>& link_touches_object);

  SimConfig config_;
  StepSolver solver_;
  StepProblem problem_;
  /** Positions at which the hand's part of problem_.M was computed. */
  struct MassPlace {
    Eigen::VectorXd q;  ///< empty: not computed yet
    Eigen::Matrix3d R_WH = Eigen::Matrix3d::Identity();
    std::vector<double> rates;  ///< by joint
    Eigen::VectorXd q_arm = {};
  };
  MassPlace mass_place_;
  int num_base_ = 6;                // number of speeds that move the base: six, or the arm's joints
  std::optional<CarryingArm> arm_;  // robot arm, if any; at middle_ during a step
  Eigen::MatrixXd hand_mass_;       // with a robot arm: as in HandDynamics
  Eigen::MatrixXd arm_mass_;        // of the arm alone
  Eigen::VectorXd arm_weight_;      // weight of arm and hand on its joints [N m]
  Eigen::VectorXd arm_carrying_;    // torques of its drives in addition to their springs [N m]
  WorldState middle_;               // of the current step
  Eigen::VectorXd v_;         // speeds at the end of the last step: [u, w_WH, v_WH, w_WO, v_WOcm]
  Eigen::VectorXd v_before_;  // at its start; empty if the next step has another length
  Eigen::Vector3d commanded_v_WH_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> carrying_ = Eigen::Matrix<double, 6, 1>::Zero();  // the hand itself
  Eigen::Vector3d external_force_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d external_moment_W_ = Eigen::Vector3d::Zero();
  std::vector<DriveMemory> drives_;  // by dof
  // Order of problem_.scalars: drives and couplings by dof, and from first_friction_ on the drives'
  // friction, num_drives_ in all; then the arm, the limits, and from first_rolling_ on the object's
  // rolling resistance.
  int first_friction_ = 0;
  int num_drives_ = 0;
  int first_rolling_ = 0;
  int step_number_ = 0;
  WorldCommand last_command_;
  StepReport last_report_;
  bool stands_ = false;  // nothing moved in the last step, and its command equalled the one before
  EnergyAccount energy_;
};

}  // namespace graspbench
