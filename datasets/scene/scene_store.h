#pragma once
/** @file
The folder of one optimised scene (a hand, an object, a standard grasp):

    scene.json                        frozen configuration, schema and program version
    manifest.json                     hashes of all of it (manifest.h)
    journal.jsonl                     every evaluation in order: lineage, fitness and its parts
    result.json                       decisions of the steps with reasons; if sealed: finished
    new-pregrasp.yaml                 the grasp after step 1, for graspbench run --grasp
    new-target.yaml                   the grasp after step 2 (each only if the step was requested)
    new-*.isaac_grasp.yaml            these grasps for other programs
    individuals.csv                   step 2's individuals as a table

All files except scene.json and journal.jsonl are derived from the journal. All have the same bytes
after any number of interruptions. */

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/optimise/grasp_optimiser.h"
#include "core/trial/trial_setup.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_config.h"
#include "datasets/scene/answer_journal.h"

namespace graspbench {

/** One scene of the optimisation: a hand, an object, the standard grasp to improve, and the
settings. Frozen in scene.json. `variation` applies to the drawn learning trials. */
struct SceneConfig : TrialConditions {
  std::string hand;
  std::string object;
  std::string grasp;  ///< id of the standard grasp
  OptimiseConfig optimise;

  template <class V>
  void Visit(V&& v) {
    v("hand", hand, "id of the hand");
    v("object", object, "id of the object");
    v("grasp", grasp, "id of the standard grasp that it begins at");
    v("optimise", optimise);
    TrialConditions::Visit(v);
  }
};

struct SceneInputs {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  Grasp grasp;
};

/** Lists all problems of the values, as Validate(SessionConfig) does. */
[[nodiscard]] std::vector<ConfigProblem> Validate(const OptimiseConfig& config);
/** @throws Error(kRange) listing them. */
void CheckOptimiseConfig(const OptimiseConfig& config);

/** Makes the setup of a learning trial. Draw 0 has no variation; the others come from the streams
of (seed, object, draw) and (seed, hand, object, draw), which no benchmark trial uses. */
TrialSetup MakeLearningSetup(const SceneConfig& config, const SceneInputs& inputs,
                             const LearningRequest& request, int draw);

/** Hash of everything that affects the trial's result, as PlannedTrial::id. */
std::string CalcLearningTrialId(const SceneConfig& config, const SceneInputs& inputs,
                                const LearningRequest& request, int draw);

/** Creates the folder, or accepts the same scene there.
@throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CreateScene(const std::filesystem::path& folder, const SceneConfig& config);

bool HasScene(const std::filesystem::path& folder);
/** Hash of the hand, the object, the grasp and the physics. */
std::string CalcInputsHash(const SceneInputs& inputs);
/** Whether the scene is finished, regardless of the hand, object and grasp used. */
bool HasSceneResult(const std::filesystem::path& folder);
/** Whether the scene is finished with the present hand, object, grasp and physics. */
bool IsSceneFinished(const std::filesystem::path& folder, const SceneInputs& inputs);

/** Writes the score of trials of one grasp for result.json; null without trials.
@param grip_limit  of their fitness [N]. */
Json MakeScore(const std::vector<LearningTrial>& trials, double grip_limit = kAnyGrip);

/** Writes all files except scene.json and journal.jsonl, and seals the store. */
void WriteSceneResult(const std::filesystem::path& folder, const SceneConfig& config,
                      const SceneInputs& inputs, const OptimisedGrasp& optimised);

/** The data dictionary of individuals.csv, with COORDINATE for each coordinate of the search. */
Json MakeIndividualSchema();

struct SceneRecord {
  SceneConfig config;
  Json result;  ///< contents of result.json; null if not finished
  std::vector<EvaluationRecord> evaluations;
  Diagnostics findings;  ///< about journal lines that were skipped
};
/** Loads a scene. @throws Error(kNotFound, kVersion, kIo); kFormat, also for damage. */
SceneRecord LoadScene(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse);

/** Loads the saved grasp of a new variant. */
Grasp LoadSceneGrasp(const std::filesystem::path& folder, Variant variant, const Hand& hand);

}  // namespace graspbench
