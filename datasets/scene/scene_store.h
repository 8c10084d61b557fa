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
#include <string>
#include <vector>

#include "datasets/journal/sealed_store.h"
#include "datasets/scene/evaluation_journal.h"
#include "datasets/scene/learning_plan.h"

namespace graspbench {

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

/** Writes everything but scene.json and journal.jsonl, and seals it. */
void WriteSceneResult(const std::filesystem::path& folder, const SceneConfig& config,
                      const SceneInputs& inputs, const OptimisedGrasp& optimised);

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
