#pragma once
/** @file
The folder of one optimised scene (a hand, an object, a standard grasp):

    scene.json                        frozen configuration, schema and program version
    journal.jsonl                     every evaluation in order: lineage, fitness and its parts
    result.json                       what the steps decided and why; its presence: finished
    new-pregrasp.yaml                 the grasp after step 1, for graspbench run --grasp
    new-target.yaml                   the grasp after step 2 (each only if the step was asked for)
    new-*.isaac_grasp.yaml            the same for other programs
    individuals.csv                   step 2's individuals as a table

All but scene.json and journal.jsonl is made from the journal; all of it has the same bytes after
any number of interruptions. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/scene/evaluation_journal.h"
#include "datasets/scene/learning_plan.h"

namespace graspbench {

/** Version of the folder's layout and records; others are refused. */
inline constexpr int kSceneSchema = 2;

/** Creates the folder, or finds the same scene there.
@throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CreateScene(const std::filesystem::path& folder, const SceneConfig& config);

bool HasScene(const std::filesystem::path& folder);
bool IsSceneFinished(const std::filesystem::path& folder);

/** Writes everything but scene.json and journal.jsonl. */
void WriteSceneResult(const std::filesystem::path& folder, const SceneConfig& config,
                      const SceneInputs& inputs, const OptimisedGrasp& optimised);

struct SceneRecord {
  SceneConfig config;
  Json result;  ///< of result.json; null when the scene is not finished
  std::vector<EvaluationRecord> evaluations;
  Diagnostics findings;  ///< about journal lines that were skipped
};
/** @throws Error(kNotFound) no scene there; kVersion; kFormat; kIo. */
SceneRecord LoadScene(const std::filesystem::path& folder);

/** The grasp of a new variant as it was saved. */
StandardGrasp LoadSceneGrasp(const std::filesystem::path& folder, Variant variant,
                             const Hand& hand);

}  // namespace graspbench
