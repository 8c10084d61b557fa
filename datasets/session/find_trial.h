#pragma once
/** @file
Finds one trial of a session by the name that a user gives. */

#include <memory>
#include <string>
#include <vector>

#include "core/trial/policy/hand_policy.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Returns the name that FindPlannedTrial accepts: "tum-can-g2:3", or under a condition
"tum-can-g2:3@model.mass_scale=2.0". */
std::string NameTrial(const PlannedTrial& planned);

/** Finds a planned trial by its id, by a unique prefix of at least 4 letters, or by its name as
from NameTrial. Case does not matter.
@throws Error(kNotFound) with suggestions; Error(kUsage) if several trials match. */
const PlannedTrial& FindPlannedTrial(const Session& session, const std::string& name);

/** Returns the record of a planned trial; null if it is not finished. */
const TrialRecord* FindRecord(const Session& session, const PlannedTrial& planned);

/** Makes the setup to re-simulate a planned trial. A controller is replaced by the actions in the
trial's record; without a record the trial cannot run. */
TrialSetup MakeRecordedSetup(const Session& session, const SessionInputs& inputs,
                             const PlannedTrial& planned);
/** Returns a policy that replays the recorded actions; null for a trial without any. */
std::shared_ptr<HandPolicy> FindRecordedPolicy(const Session& session, const PlannedTrial& planned);

/** The successful trial of the same cell whose object pose is nearest to that of `planned`; null if
there is none. */
struct NearestSuccess {
  const TrialRecord* record = nullptr;
  double distance = 0.0;  ///< from CalcDrawDistance [m]
};
/** @param radius  of the object, half its length in x [m]. */
NearestSuccess FindNearestSuccess(const Session& session, const PlannedTrial& planned,
                                  double radius);

/** Loads only the hands and objects that MakeTrialSetup needs for one trial.
@throws as LoadSessionInputs. */
SessionInputs LoadTrialInputs(const Session& session, const PlannedTrial& planned);

/** Checks that an experiment belongs to a session. Experiments are sessions in its subfolders, such
as `sensitivity/3f2a9c01`, that repeat its draws under other conditions (workbench/experiments). A
folder copied from elsewhere may have matching draws, so its configuration is compared.

@param name  path of the experiment relative to the session's folder.
@throws Error(kFormat) if its configuration differs in more than the number of trials and the
conditions (in schedules/ also the grasps). A changed object with the same name is not detected. */
void CheckIsExperimentOn(const Session& session, const Session& experiment,
                         const std::string& name);

/** Loads the experiments of one kind, sorted by name, with brief records; none for a session
without a folder. @throws as LoadSession, CheckIsExperimentOn. */
std::vector<Session> LoadExperiments(const Session& session, const std::string& kind);

}  // namespace graspbench
