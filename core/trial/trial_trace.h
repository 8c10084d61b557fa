#pragma once
/** @file
A trial seen instant by instant: what its record, which keeps three postures, does not hold. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

/** At the end of a step. */
struct TraceInstant {
  double time = 0.0;              ///< since the start of placing [s]
  Phase phase = Phase::kPlacing;  ///< of the step that ended; the last of a whole trial: hold
  /** That goes on from here, as the record's phases say: another one at the end of a phase. */
  Phase next_phase = Phase::kPlacing;
  Pose X_WH = Pose::Identity();
  Pose X_WO = Pose::Identity();
  Eigen::VectorXd q;        ///< (num_joints) [rad], [m]
  Eigen::VectorXd q_asked;  ///< of the drives, in the order of q; empty before the first step
  Eigen::VectorXd q_arm;    ///< of the robot arm [rad]; empty: there is none, or it has no course
  std::vector<HandContact> contacts;
  double grip_force = 0.0;   ///< sum of the hand's normal forces on the object [N]
  double table_force = 0.0;  ///< normal force of the table on the object [N]
};

/** The world now. @param report  of the last step.  @param command  of it. */
TraceInstant MakeTraceInstant(const World& world, double time, Phase phase,
                              const StepReport& report, const WorldCommand& command);

struct TracedTrial {
  TrialResult result;  ///< that of TrialRunner::Run, to the last byte
  /** From the start to the end of the trial; empty when it could not begin. */
  std::vector<TraceInstant> trace;
  /** Since the start of placing [s]; the result's times count from it. NaN: it was not reached. */
  double closure_start = kUnset;
  std::shared_ptr<const MountedArm> arm;  ///< that carries the hand; null: none
};

/** Runs a trial and keeps its instants, some 2 kB each. Never throws for what happens inside it.
@param interval  of the instants, rounded up to whole steps [s]; the first, the last and the end of
each phase are always kept. */
TracedTrial TraceTrial(TrialRunner& runner, const TrialSetup& setup, double interval);

/** The last instant of each phase that was reached, in their order: the very instants at which the
next one begins, and the end of the trial. */
std::vector<const TraceInstant*> ListPhaseEnds(const std::vector<TraceInstant>& trace);

/** The instant nearest to a time. @pre the trace is not empty. */
const TraceInstant& FindInstant(const std::vector<TraceInstant>& trace, double time);

}  // namespace graspbench
