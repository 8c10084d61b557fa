#pragma once
/** @file
One trial of a session, by the name that a person has for it. */

#include <memory>
#include <string>
#include <vector>

#include "core/trial/policy/hand_policy.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** "tum-can-g2:3", or "tum-can-g2:3@model.mass_scale=2.0" under a condition, as FindPlannedTrial
takes it. */
std::string NameTrial(const PlannedTrial& planned);

/** The planned trial of an id, of the first letters of one (4 at least, as long as they belong to
one trial only), or as NameTrial has it, numbers within the cell from 0. Case does not matter.
@throws Error(kNotFound) with what is known; Error(kUsage) when several trials begin so. */
const PlannedTrial& FindPlannedTrial(const Session& session, const std::string& name);

/** The record of a planned trial; null while it is not finished. */
const TrialRecord* FindRecord(const Session& session, const PlannedTrial& planned);

/** What runs a planned trial again: a controller gives the actions of the trial's record, and where
there is no record the trial cannot run. */
TrialSetup MakeRecordedSetup(const Session& session, const SessionInputs& inputs,
                             const PlannedTrial& planned);
/** Those actions; null for a trial without. */
std::shared_ptr<HandPolicy> FindRecordedPolicy(const Session& session, const PlannedTrial& planned);

/** The successful trial of the same cell whose object stood nearest to that of `planned`; null
without any. */
struct NearestSuccess {
  const TrialRecord* record = nullptr;
  double distance = 0.0;  ///< see CalcDrawDistance [m]
};
/** @param radius  of the object, half its length in x [m]. */
NearestSuccess FindNearestSuccess(const Session& session, const PlannedTrial& planned,
                                  double radius);

/** Hands and objects for MakeTrialSetup of one trial: not more of them than needed.
@throws as LoadSessionInputs. */
SessionInputs LoadTrialInputs(const Session& session, const PlannedTrial& planned);

/** Experiments on a session: sessions in folders below it, `sensitivity/3f2a9c01` for instance,
whose trials repeat its draws under conditions of their own (workbench/experiments). Whoever
compares the two must know that they belong together: a folder that was copied from elsewhere fits
by the names of its draws alone.

@param name  of the experiment's folder, from the session's.
@throws Error(kFormat) where it is of another session: of another configuration but for the number
of trials and the conditions, below schedules/ also the grasps. Another version of an object under
the same name is not noticed. */
void CheckIsExperimentOn(const Session& session, const Session& experiment,
                         const std::string& name);

/** Those in folders of one kind, in the order of their names, with brief records; none for a session
that stands in no folder. @throws as LoadSession, CheckIsExperimentOn. */
std::vector<Session> LoadExperiments(const Session& session, const std::string& kind);

}  // namespace graspbench
