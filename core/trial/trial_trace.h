#pragma once
/** @file
Trace of a trial at many instants, beyond the three postures that its record keeps. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

/** State after a step. */
struct TraceInstant {
  double time = 0.0;              ///< since the start of placing [s]
  Phase phase = Phase::kPlacing;  ///< of the completed step; the last of a complete trial is hold
  /** Phase that continues from here according to the record; differs from `phase` at its end. */
  Phase next_phase = Phase::kPlacing;
  Pose X_WH = Pose::Identity();
  Pose X_WO = Pose::Identity();
  Eigen::VectorXd q;        ///< (num_joints) [rad], [m]
  Eigen::VectorXd q_asked;  ///< drive setpoints in the order of q; empty before the first step
  Eigen::VectorXd q_arm;    ///< joints of the robot arm [rad]; empty: no arm, or no course for it
  std::vector<HandContact> contacts;
  double grip_force = 0.0;   ///< sum of the hand's normal forces on the object [N]
  double table_force = 0.0;  ///< normal force of the table on the object [N]
};

/** Records the current state of the world. @param report  of the last step.  @param command  of
that step. */
TraceInstant MakeTraceInstant(const World& world, double time, Phase phase,
                              const StepReport& report, const WorldCommand& command);

struct TracedTrial {
  TrialResult result;  ///< byte-identical to that of TrialRunner::Run
  /** From the start to the end of the trial; empty if it could not start. */
  std::vector<TraceInstant> trace;
  /** Since the start of placing [s]; the result's times count from it. NaN: not reached. */
  double closure_start = kUnset;
  std::shared_ptr<const MountedArm> arm;  ///< robot arm that carries the hand; null: none
};

/** Runs a trial and stores its instants, about 2 kB each. Never throws for events within the trial.
@param interval  between instants, rounded up to whole steps [s]. The first and last instants and
the end of each phase are always stored. */
TracedTrial TraceTrial(TrialRunner& runner, const TrialSetup& setup, double interval);

/** Returns the last instant of each phase that was reached, in order. It is also the instant at
which the next phase begins, or the end of the trial. */
std::vector<const TraceInstant*> ListPhaseEnds(const std::vector<TraceInstant>& trace);

/** Returns the instant nearest to a time. @pre the trace is not empty. */
const TraceInstant& FindInstant(const std::vector<TraceInstant>& trace, double time);

}  // namespace graspbench
