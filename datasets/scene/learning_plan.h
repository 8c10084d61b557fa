#pragma once
/** @file
One scene of the optimisation, a hand, an object and the standard grasp to improve: its settings,
its trials' ids and draws. */

#include <memory>
#include <string>

#include "core/optimise/grasp_optimiser.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

/** Frozen in scene.json; the variation is that of the drawn learning trials. */
struct SceneConfig : TrialConditions {
  std::string hand;
  std::string object;
  std::string grasp;  ///< id of the standard grasp
  OptimiseConfig optimise;

  template <class V>
  void Visit(V&& v) {
    v("hand", hand);
    v("object", object);
    v("grasp", grasp);
    v("optimise", optimise);
    TrialConditions::Visit(v);
  }
};

struct SceneInputs {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  Grasp grasp;
};

/** Adds to the frozen configuration of a scene or campaign what older ones lack: they searched the
thumb for sigma. */
void CompleteOptimiseConfig(Json& config);

/** All problems of the values, as Validate(SessionConfig) reports them. */
[[nodiscard]] std::vector<ConfigProblem> Validate(const OptimiseConfig& config);
/** @throws Error(kRange) listing them. */
void CheckOptimiseConfig(const OptimiseConfig& config);

/** The draw of a number: 0 without variation, else from streams of (seed, object, number) and
(seed, hand, object, number) that no benchmark trial uses. */
TrialSetup MakeLearningSetup(const SceneConfig& config, const SceneInputs& inputs,
                             const LearningRequest& request, int draw);

/** Hash of all that decides the trial's result, as PlannedTrial::id. */
std::string CalcLearningTrialId(const SceneConfig& config, const SceneInputs& inputs,
                                const LearningRequest& request, int draw);

}  // namespace graspbench
