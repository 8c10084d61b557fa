#include "workbench/experiments/policies/live_policies.h"

#include <map>
#include <string>

#include "datasets/session/find_trial.h"
#include "workbench/experiments/policies/child_policy.h"

namespace graspbench {

FindPolicy MakeLivePolicies() {
  const auto known = std::make_shared<std::map<std::string, std::shared_ptr<HandPolicy>>>();
  return [known](const TrialSetup& setup, const PlannedTrial&) -> std::shared_ptr<HandPolicy> {
    const std::string& command = setup.policy.command;
    if (command.empty()) return nullptr;
    std::shared_ptr<HandPolicy>& policy = (*known)[command];
    if (!policy) policy = MakeChildPolicy(command);
    return policy;
  };
}

FindPolicy MakeRecordedPolicies(const Session& session) {
  return [&session](const TrialSetup&, const PlannedTrial& planned) {
    return FindRecordedPolicy(session, planned);
  };
}

}  // namespace graspbench
