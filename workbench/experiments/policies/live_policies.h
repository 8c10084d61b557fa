#pragma once
/** @file
Controllers started for trials: each worker starts one per command, for the first trial that needs
it. */

#include <functional>
#include <memory>

#include "core/trial/policy/hand_policy.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_plan.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Returns the controller of a trial; null: the strategy controls the digits. */
using FindPolicy = std::function<std::shared_ptr<HandPolicy>(const TrialSetup& setup,
                                                             const PlannedTrial& planned)>;

/** Makes the controllers of one worker; they end with it. */
FindPolicy MakeLivePolicies();

/** Checks a session's policies, their files and addresses, before its folder is created.
@throws Error with the problem. */
void CheckPolicies(const SessionConfig& config, const SessionInputs& inputs,
                   const std::vector<PlannedTrial>& plan);

/** Makes controllers that replay the recorded actions of a session. @pre the session outlives
it. */
FindPolicy MakeRecordedPolicies(const Session& session);

}  // namespace graspbench
