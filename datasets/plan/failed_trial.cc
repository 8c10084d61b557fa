#include "datasets/plan/failed_trial.h"

#include <algorithm>

#include "datasets/plan/grasp_choice.h"

namespace graspbench {

FailedTrial MakeFailedTrial(const SessionConfig& config, const SessionInputs& inputs,
                            const PlannedTrial& planned, const TrialSetup& setup) {
  FailedTrial failed{setup, {}, {}, {}};
  PlannedTrial fresh = planned;
  for (int i = 0; i < kNumFreshDraws; ++i) {
    fresh.trial = kFirstFreshDraw + i;
    failed.fresh.push_back(MakeTrialSetup(config, inputs, fresh).draw);
  }
  const ConditionInputs* condition =
      planned.condition ? &inputs.conditions.at(*planned.condition) : nullptr;
  const SessionInputs& own = condition && condition->inputs ? *condition->inputs : inputs;
  SessionConfig all = condition ? condition->config : config;
  all.grasps = {"all"};
  const auto has_id = [&](const SessionHand& hand) { return hand.hand->id == planned.hand; };
  const auto hand = std::find_if(own.hands.begin(), own.hands.end(), has_id);
  const auto object = std::find_if(own.objects.begin(), own.objects.end(),
                                   [&](const auto& one) { return one->id == planned.object; });
  GRASPBENCH_DEMAND(hand != own.hands.end() && object != own.objects.end(), planned.id);
  for (const GraspEntry& entry : ListGraspEntries(all, own, *hand, *object)) {
    if (entry.grasps.size() != 1 || entry.id == planned.grasp) continue;
    failed.grasps.push_back(FindFitted(own, *hand, *entry.grasps.front(), *object));
  }
  return failed;
}

}  // namespace graspbench
