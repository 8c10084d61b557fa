#include "core/optimise/grasp_check.h"

#include <numeric>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

LearningRequest MakeCheckRequest(LearningStage stage, const Grasp& grasp,
                                 const std::vector<int>& draws, bool finds_strength) {
  LearningRequest request;
  request.stage = stage;
  request.grasp = grasp;
  request.draws = draws;
  request.finds_strength = finds_strength;
  return request;
}

PairedEvidence CollectEvidence(const GraspCheck& check, const CheckPlan& plan) {
  PairedEvidence evidence;
  for (size_t i = 0; i < check.before.size(); ++i) {
    const LearningTrial &before = check.before[i], &after = check.after[i];
    evidence.success.Add(before.outcome == Outcome::kSuccess, after.outcome == Outcome::kSuccess);
    evidence.num_better += plan.goal(after) > plan.goal(before);
    evidence.num_worse += plan.goal(after) < plan.goal(before);
  }
  return evidence;
}

}  // namespace

std::vector<int> ListDraws(int first, int count) {
  std::vector<int> draws(static_cast<size_t>(count));
  std::iota(draws.begin(), draws.end(), first);
  return draws;
}

GraspCheck CheckGrasp(const Grasp& before, const Grasp& after, const CheckPlan& plan,
                      const RunLearningTrials& run) {
  GraspCheck check;
  const int num_looks = plan.most_pairs / kPairsPerLook;
  for (int look = 1; check.decision == PairedDecision::kGoOn && look <= num_looks; ++look) {
    const std::vector<int> draws =
        ListDraws(plan.first_draw + (look - 1) * kPairsPerLook, kPairsPerLook);
    const auto ask = [&](LearningStage stage, const Grasp& grasp) {
      return MakeCheckRequest(stage, grasp, draws, plan.finds_strength);
    };
    const auto trials =
        run({ask(LearningStage::kCheckBefore, before), ask(LearningStage::kCheckAfter, after)});
    check.before.insert(check.before.end(), trials[0].begin(), trials[0].end());
    check.after.insert(check.after.end(), trials[1].begin(), trials[1].end());
    check.decision = Decide(CollectEvidence(check, plan), look, num_looks);
  }
  return check;
}

GraspCheck CheckOldGrasp(const Grasp& before, const CheckPlan& plan, const RunLearningTrials& run) {
  GraspCheck check;
  check.before =
      run({MakeCheckRequest(LearningStage::kCheckBefore, before,
                            ListDraws(plan.first_draw, kPairsPerLook), plan.finds_strength)})
          .at(0);
  return check;
}

std::string DescribeRefusal(const GraspCheck& check, const std::string& kept,
                            const std::string& changed, const std::string& missed) {
  switch (check.decision) {
    case PairedDecision::kTaken:
      return check.is_taken() ? ""
                              : kept + " kept: " + changed + " held in none of " +
                                    FormatCount(static_cast<int>(check.after.size()), "trial");
    case PairedDecision::kSucceedsLess:
      return kept + " kept: " + changed + " succeeded less often";
    case PairedDecision::kIsNotBetter:
      return kept + " kept: " + missed;
    case PairedDecision::kIsNotDecided:
    case PairedDecision::kGoOn:
      break;
  }
  return kept + " kept: not decided after " +
         FormatCount(static_cast<int>(check.before.size()), "pair") + " of trials";
}

}  // namespace graspbench
