#include "datasets/plan/failed_trial.h"

#include <algorithm>

#include "core/grasp/grasp_file.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/rehearsed_grasps.h"

namespace graspbench {
namespace {

/** As a session with --grasp rehearsed reads it; none for a hand without a standard grasp. */
std::vector<Grasp> ListRehearsed(const SessionConfig& config, const SessionHand& hand,
                                 const std::shared_ptr<const GraspObject>& object) {
  const RehearsalConfig rehearsal;
  RehearsalTask task = MakeRehearsalTask(config, rehearsal, hand.hand, hand.grasps, object);
  task.arm = hand.arm;
  if (task.grasps.empty()) return {};
  const std::string id = NameRehearsed(rehearsal);
  const std::string text = FormatRehearsedGrasp(task, FindRehearsal(task).choice().candidate, id);
  return {ParseGraspFile(text, id, {hand.hand.get()}).grasp};
}

}  // namespace

FailedTrial MakeFailedTrial(const SessionConfig& config, const SessionInputs& inputs,
                            const PlannedTrial& planned, const TrialSetup& setup,
                            ExplainDepth depth) {
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
  const bool is_rehearsed = ParseRehearsed(planned.grasp).has_value();
  if (depth == ExplainDepth::kFull && !is_rehearsed) {
    failed.grasps = ListRehearsed(all, *hand, setup.object);
  }
  for (const GraspEntry& entry : ListGraspEntries(all, own, *hand, *object)) {
    if (entry.grasps.size() != 1 || entry.id == planned.grasp) continue;
    failed.grasps.push_back(FindFitted(own, *hand, *entry.grasps.front(), *object));
  }
  return failed;
}

}  // namespace graspbench
