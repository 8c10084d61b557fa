#include "workbench/experiments/policies/live_policies.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "workbench/experiments/policies/child_policy.h"
#include "workbench/experiments/policies/policy_server.h"
#include "workbench/experiments/policies/websocket_policy.h"

namespace graspbench {
namespace {

std::unique_ptr<HandPolicy> MakeLivePolicy(const std::string& command) {
  if (IsPolicyServer(command)) return MakeWebsocketPolicy(LoadPolicyServer(command));
  return MakeChildPolicy(command);
}

}  // namespace

FindPolicy MakeLivePolicies() {
  const auto known = std::make_shared<std::map<std::string, std::shared_ptr<HandPolicy>>>();
  return [known](const TrialSetup& setup, const PlannedTrial&) -> std::shared_ptr<HandPolicy> {
    const std::string& command = setup.policy.command;
    if (command.empty()) return nullptr;
    std::shared_ptr<HandPolicy>& policy = (*known)[command];
    if (!policy) policy = MakeLivePolicy(command);
    return policy;
  };
}

void CheckPolicies(const SessionConfig& config, const SessionInputs& inputs,
                   const std::vector<PlannedTrial>& plan) {
  std::set<std::pair<std::string, std::optional<std::string>>> known;  // hands and conditions
  for (const PlannedTrial& planned : plan) {
    if (!known.emplace(planned.hand, planned.condition).second) continue;
    const PolicyConfig& policy =
        planned.condition ? inputs.conditions.at(*planned.condition).config.policy : config.policy;
    if (!IsPolicyServer(policy.command)) continue;
    const PolicyServer server = LoadPolicyServer(policy.command);
    CheckPolicyServer(server, *MakeTrialSetup(config, inputs, planned).hand, policy);
    MakeWebsocketPolicy(server);  // finds its host
  }
}

FindPolicy MakeRecordedPolicies(const Session& session) {
  const auto records = std::make_shared<std::unordered_map<std::string, const TrialRecord*>>();
  for (const TrialRecord& record : session.records) {
    if (record.result.policy) records->emplace(record.plan.id, &record);
  }
  return [&session, records](const TrialSetup&,
                             const PlannedTrial& planned) -> std::shared_ptr<HandPolicy> {
    const auto found = records->find(planned.id);
    if (found == records->end()) return nullptr;
    return MakeRecordedPolicy(*LoadWhole(session, *found->second).result.policy);
  };
}

}  // namespace graspbench
