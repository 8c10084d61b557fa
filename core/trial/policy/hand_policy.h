#pragma once
/** @file
Interface of an external controller, which controls the digits and, depending on policy.moves, the
hand in a trial of the protocol policy_lift. It receives an observation every control period and
returns an action; simulated time waits for it. All its inputs and outputs are listed in tables
(policy_terms.h).

There are two kinds of failure. An invalid answer (PolicyFault) ends the trial with an outcome. A
lost or silent controller (PolicyLost) leaves the trial without a result. */

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

/** The answer is invalid, which determines the outcome of the trial. */
class PolicyFault : public Error {
 public:
  explicit PolicyFault(const std::string& reason) : Error(ErrorKind::kFormat, reason) {}
};

/** The controller was lost; the trial has no result. */
class PolicyLost : public Error {
 public:
  explicit PolicyLost(const std::string& reason) : Error(ErrorKind::kEnvironment, reason) {}
};

/** State of a trial from which observations are computed. */
struct PolicyView {
  const TrialSetup& setup;
  const std::vector<int>& driven;  ///< joints with their own drive, indices into Hand::joints
  World& world;
  const StepReport& report;                  ///< of the last step
  const std::vector<HandContact>& contacts;  ///< of the last step
  const TouchSensors* sensors;               ///< null: touch is exact
  const Eigen::VectorXd& targets;            ///< last setpoints of the driven joints
  const Eigen::VectorXd& stiffness;          ///< last stiffness scales; empty: 1 for all joints
  const Pose& told_X_WO;                     ///< object pose given to it, if not the true one
  const Pose& placed_X_WH;                   ///< hand pose of the grasp
  /** Renders the wrist camera's image; empty: no image. */
  const std::function<Image()>& take_picture;
  double time;           ///< since the start of control [s]
  Phase phase;           ///< closure or stabilisation
  double time_in_phase;  ///< [s]
  int question;          ///< number of the question in the trial, from 1; 0: none yet
};

struct PolicyAction {
  /** One row per control period: setpoints of the driven joints, or increments of the last ones
  (num_rows x num_driven) [rad], [m] if prismatic. */
  Eigen::MatrixXd rows;
  bool are_increments = false;
  /** X_WH of each row, to be reached within a control period; empty: the hand is not commanded.
  Alternatively twists: velocity of the hand's origin and rotation, along W's axes [m/s],
  [rad/s]. */
  std::vector<Pose> poses = {};
  Eigen::Matrix<double, Eigen::Dynamic, 6> twists = {};
  Eigen::MatrixXd stiffness = {};     ///< stiffness scales by row and joint; empty: unchanged
  std::optional<GripMode> hold = {};  ///< the regulator takes over after the first row
  bool is_done = false;  ///< lift the hand after the first row, or at once without rows
};

/** A controller for one trial after another; used by one thread only. */
class HandPolicy {
 public:
  virtual ~HandPolicy() = default;
  /** Starts a trial. @throws PolicyFault, PolicyLost. */
  virtual void Begin(const PolicyView& view) = 0;
  /** @throws PolicyFault, PolicyLost. */
  virtual PolicyAction Answer(const PolicyView& view) = 0;
};

/** Replays the actions of a record, whatever the observations. */
std::shared_ptr<HandPolicy> MakeRecordedPolicy(const PolicyRecord& record);

}  // namespace graspbench
