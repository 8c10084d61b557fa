#pragma once
/** @file
The folder of one optimised scene (a hand, an object, a standard grasp):

    scene.json                        frozen configuration, schema and program version
    manifest.json                     hashes of all of it (manifest.h)
    journal.jsonl                     every evaluation in order: lineage, fitness and its parts
    result.json                       what the steps decided and why; in the manifest: finished
    new-pregrasp.yaml                 the grasp after step 1, for graspbench run --grasp
    new-target.yaml                   the grasp after step 2 (each only if the step was asked for)
    new-*.isaac_grasp.yaml            the same for other programs
    individuals.csv                   step 2's individuals as a table

All but scene.json and journal.jsonl is made from the journal; all of it has the same bytes after
any number of interruptions. */

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

/** One scene of the optimisation, a hand, an object and the standard grasp to improve: its settings,
its trials' ids and draws.

Frozen in scene.json; the variation is that of the drawn learning trials. */
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

/** Creates the folder, or finds the same scene there.
@throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CreateScene(const std::filesystem::path& folder, const SceneConfig& config);

bool HasScene(const std::filesystem::path& folder);
/** Hash of the hand, the object, the grasp and the physics. */
std::string CalcInputsHash(const SceneInputs& inputs);
/** True when it was finished, with whatever hand, object and grasp. */
bool HasSceneResult(const std::filesystem::path& folder);
/** True when it was finished with the hand, the object, the grasp and the physics of today. */
bool IsSceneFinished(const std::filesystem::path& folder, const SceneInputs& inputs);

/** What result.json says of some trials of one grasp; null: of none.
@param grip_limit  that of their fitness [N]. */
Json MakeScore(const std::vector<LearningTrial>& trials, double grip_limit = kAnyGrip);

/** Writes everything but scene.json and journal.jsonl, and seals it. */
void WriteSceneResult(const std::filesystem::path& folder, const SceneConfig& config,
                      const SceneInputs& inputs, const OptimisedGrasp& optimised);

/** The data dictionary of individuals.csv, with COORDINATE for each coordinate of the search. */
Json MakeIndividualSchema();

struct SceneRecord {
  SceneConfig config;
  Json result;  ///< of result.json; null when the scene is not finished
  std::vector<EvaluationRecord> evaluations;
  Diagnostics findings;  ///< about journal lines that were skipped
};
/** @throws Error(kNotFound) no scene there; kVersion; kFormat, also for damage; kIo. */
SceneRecord LoadScene(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse);

/** The grasp of a new variant as it was saved. */
Grasp LoadSceneGrasp(const std::filesystem::path& folder, Variant variant, const Hand& hand);

}  // namespace graspbench
