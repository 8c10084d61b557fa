#pragma once
/** @file
Who controls the digits, and as policy.moves says the hand, in a trial of the protocol policy_lift:
a controller of somebody else. It gets an observation every control period and gives an action;
simulated time waits for it. What it may know and ask for is in one table each (policy_terms.h).

Two things can go wrong. A controller that answers wrongly (PolicyFault) ends its trial with an
outcome. One that is lost or silent (PolicyLost) leaves the trial without any result. */

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/policy/policy_config.h"
#include "core/trial/policy/policy_record.h"

namespace graspbench {

struct Image;
struct TrialSetup;
class TouchSensors;

/** The answer is wrong: it decides the trial. */
class PolicyFault : public Error {
 public:
  explicit PolicyFault(const std::string& reason) : Error(ErrorKind::kFormat, reason) {}
};

/** Nothing is known of the trial. */
class PolicyLost : public Error {
 public:
  explicit PolicyLost(const std::string& reason) : Error(ErrorKind::kEnvironment, reason) {}
};

/** An instant of a trial, of which observations are taken. */
struct PolicyView {
  const TrialSetup& setup;
  const std::vector<int>& driven;  ///< joints with a drive of their own, indices into Hand::joints
  World& world;
  const StepReport& report;                  ///< of the last step
  const std::vector<HandContact>& contacts;  ///< of the last step
  const TouchSensors* sensors;               ///< null: touch is exact
  const Eigen::VectorXd& targets;            ///< of the driven joints, the last ones asked for
  const Eigen::VectorXd& stiffness;          ///< likewise; empty: of all joints 1
  const Pose& told_X_WO;                     ///< of the object, where it is not the true one
  const Pose& placed_X_WH;                   ///< where the grasp places the hand
  /** Of the wrist camera; empty: it takes none. */
  const std::function<Image()>& take_picture;
  double time;           ///< of control [s]
  Phase phase;           ///< closure or stabilisation
  double time_in_phase;  ///< [s]
  int question;          ///< of the trial, from 1; 0: none was asked
};

struct PolicyAction {
  /** A row per control period: targets of the driven joints, or what is added to the last ones
  (num_rows x num_driven) [rad], of prismatic joints [m]. */
  Eigen::MatrixXd rows;
  bool are_increments = false;
  /** X_WH of each row, to be reached within a control period; empty: the hand is not asked to move.
  Or twists: of the hand's origin and rotation along W's axes [m/s], [rad/s]. */
  std::vector<Pose> poses = {};
  Eigen::Matrix<double, Eigen::Dynamic, 6> twists = {};
  Eigen::MatrixXd stiffness = {};     ///< scale for each row's joints; empty: as before
  std::optional<GripMode> hold = {};  ///< after the first row the regulator takes over
  bool is_done = false;  ///< after the first row, of none at once: the hand is to be lifted
};

/** A controller in one trial after the other; used by one thread. */
class HandPolicy {
 public:
  virtual ~HandPolicy() = default;
  /** A trial begins. @throws PolicyFault, PolicyLost. */
  virtual void Begin(const PolicyView& view) = 0;
  /** @throws PolicyFault, PolicyLost. */
  virtual PolicyAction Answer(const PolicyView& view) = 0;
};

/** Gives again what a record says, whatever it is asked. */
std::shared_ptr<HandPolicy> MakeRecordedPolicy(const PolicyRecord& record);

}  // namespace graspbench
