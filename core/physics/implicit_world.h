#pragma once
/** @file
The default backend: contact solved implicitly on top of the hand's rigid body dynamics.

One step of length h goes from (q, u) to (q + h (u + v) / 2, v):
1. positions move by h u / 2 to the middle of the step (the object turns by its rotation vector);
2. mass matrix, bias and contacts are taken there. The hand's mass matrix is kept until a joint, or
   the hand, has turned by kKeptAngle; its forces of velocity count above kFastSpeed;
3. the implicit solve gives the speeds v at the end (step_solver.h); the bias is that of the mean
   speeds (u + v) / 2, so that the smooth part is second order and keeps its energy;
4. positions move by h v / 2.

Drives act by the means of command and angle at the step's start and end (the trapezoidal rule: a
drive without damping swings on, whatever its stiffness) and by the speed of its end; so a finger
lags behind a ramp by damping over stiffness whatever the step. Contacts and limits look farther
ahead, from the middle by the whole of h v, which makes stiff springs settle in one step instead of
ringing.

What rolls on the table under the force N is braked by a moment of at most
SimConfig::table_rolling_resistance N against its turn about the horizontal; it gives way in
proportion below kRollingRestSpeed, so that what has come to rest stays there.

The hand hangs on an arm: a spring with damping beside it, in six dimensions, between the hand's
base and where it is commanded to be, that gives no more than the arm can (SimConfig). The arm
carries the hand itself: its weight and inertia along the commanded motion load no spring, so that
a hand that touches nothing is where it is commanded to be. The arm's own inertia is not modelled.
Where WorldState names a robot arm, its joints take the place of that spring (carrying_arm.h).

Where everything stands and nothing that acts has changed, a step changes nothing: it is not
calculated and its report is that of the last one.

A clone goes on to the very same bytes: it carries the bristles of all contacts, the speeds the
solver starts from, the blocked links, the drives' imperfections, loads and the account of energy.
*/

#include <memory>
#include <optional>

#include "core/physics/carrying_arm.h"
#include "core/physics/imperfect_drive.h"
#include "core/physics/step_solver.h"
#include "core/physics/world.h"

namespace graspbench {

/** [rad/s] */
inline constexpr double kRollingRestSpeed = 1e-3;

/** Energy account [J]. Were the integration exact,
kinetic_energy - start = drives + arm + gravity + contacts + limits + external; the rest is the
residual. */
struct EnergyAccount {
  double drives = 0.0;    ///< work of the drives, their friction and yielding couplings on joints
  double arm = 0.0;       ///< work of the arm on the hand's base
  double limits = 0.0;    ///< work of the joint limits and of the stops of coupled joints
  double gravity = 0.0;   ///< work of gravity
  double contacts = 0.0;  ///< work of the contacts on hand and object; minus what they dissipate
  double external = 0.0;  ///< work of the external load on the object
  double kinetic_at_start = 0.0;
};

/** The solver keeps room for contacts of links behind so many joints (ContactPoint::kMaxChain).
@param num_base  speeds that move the hand's base: six, or the joints of a robot arm.
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
  /** Forces of the step's end at the places of its middle, in the collider's order. */
  void FindHandContacts(std::vector<HandContact>& contacts) const override;
  double CalcEnergyResidual() override;

  const EnergyAccount& energy() const { return energy_; }

 private:
  void MovePositions(double h, const Eigen::VectorXd& u, WorldState& state) const;
  /** Positions of the hand and the mass matrix at middle_. */
  void UpdateDynamics();
  /** The hand's part of the mass matrix, where that has changed enough. */
  void UpdateHandMass();
  /** Whether the step asks for nothing new. */
  bool IsAsBefore(const WorldCommand& command) const;
  void AddDrives(const WorldCommand& command);
  /** Forces of what carries the base, one for each of its speeds. */
  void AddArm(const WorldCommand& command);
  /** Of the first of the object's six speeds. */
  int object_dof() const { return dynamics_.num_dofs() + num_base_; }
  /** Of state_, as the problem has them. */
  Eigen::VectorXd FindSpeeds() const;
  // With a robot arm, whose joints' speeds take the place of the base's six (carried_world.cc):
  void ResetArm();
  /** Speeds of the hand as HandDynamics has them, of speeds of the problem. */
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
  /** Accounts for the work of all forces and moves what contacts remember. */
  void FinishForces(const Eigen::VectorXd& v);
  double CalcTouchAge(const ContactPoint& contact) const;
  StepReport MakeReport(const Eigen::VectorXd& v, bool converged) const;
  void UpdateBlocks(const std::vector<bool>& link_touches_object);

  SimConfig config_;
  StepSolver solver_;
  StepProblem problem_;
  /** Where the hand's part of problem_.M was calculated. */
  struct MassPlace {
    Eigen::VectorXd q;  ///< empty: nowhere
    Eigen::Matrix3d R_WH = Eigen::Matrix3d::Identity();
    std::vector<double> rates;  ///< by joint
    Eigen::VectorXd q_arm = {};
  };
  MassPlace mass_place_;
  int num_base_ = 6;                // speeds that move the base: six, or the arm's joints
  std::optional<CarryingArm> arm_;  // a robot arm, at middle_ within a step
  Eigen::MatrixXd hand_mass_;       // with it, as HandDynamics has it
  Eigen::MatrixXd arm_mass_;        // of the arm alone
  Eigen::VectorXd arm_weight_;      // of arm and hand on its joints [N m]
  Eigen::VectorXd arm_carrying_;    // torques of its drives beside their springs [N m]
  WorldState middle_;               // of the current step
  Eigen::VectorXd v_;         // speeds at the end of the last step: [u, w_WH, v_WH, w_WO, v_WOcm]
  Eigen::VectorXd v_before_;  // at its start; empty where the next step has another length
  Eigen::Vector3d commanded_v_WH_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> carrying_ = Eigen::Matrix<double, 6, 1>::Zero();  // the hand itself
  Eigen::Vector3d external_force_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d external_moment_W_ = Eigen::Vector3d::Zero();
  std::vector<DriveMemory> drives_;  // by dof
  // The first entries of problem_.scalars: drives and couplings by dof, then the drives' friction
  // from first_friction_ on, num_drives_ in all; then those of the arm, the limits, and from
  // first_rolling_ on the object's rolling resistance.
  int first_friction_ = 0;
  int num_drives_ = 0;
  int first_rolling_ = 0;
  int step_number_ = 0;
  WorldCommand last_command_;
  StepReport last_report_;
  bool stands_ = false;  // nothing moved in the last step, whose command was that before it
  EnergyAccount energy_;
};

}  // namespace graspbench
