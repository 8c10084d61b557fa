#pragma once
/** @file
Controllers that are started for trials: one of each command a worker, when the first trial asks for
it. */

#include <functional>
#include <memory>

#include "core/trial/policy/hand_policy.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_plan.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** The controller of a trial; null: its digits are the strategy's. */
using FindPolicy = std::function<std::shared_ptr<HandPolicy>(const TrialSetup& setup,
                                                             const PlannedTrial& planned)>;

/** For one worker; they end with it. */
FindPolicy MakeLivePolicies();

/** What can be said of a session's policies before its folder is made: their files and addresses.
@throws Error with what is wrong. */
void CheckPolicies(const SessionConfig& config, const SessionInputs& inputs,
                   const std::vector<PlannedTrial>& plan);

/** What the records of a session say. @pre the session outlives it. */
FindPolicy MakeRecordedPolicies(const Session& session);

}  // namespace graspbench
