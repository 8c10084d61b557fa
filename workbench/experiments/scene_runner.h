#pragma once
/** @file
Optimises one scene in its folder; trials found in the journal are not simulated again. */

#include <filesystem>
#include <functional>

#include "datasets/campaign/campaign_store.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

/** Called for every finished learning trial, whether simulated or found in the journal. */
using ObserveLearning =
    std::function<void(const LearningRequest& request, const LearningTrial& trial)>;

/** Returns a function that runs an optimisation's trials and keeps them in `journal`; all
references must outlive it.
@throws Error(kUsage) (the function) when the journal does not match the requests: the hand, the
object, the physics or the program has changed since. */
RunLearningTrials MakeJournaledTrials(const SceneConfig& config, const SceneInputs& inputs,
                                      EvaluationJournal& journal, TrialPool& pool,
                                      const ObserveLearning& observe);

/** Loads the hand, the object and the grasp; "best" is replaced by the grasp it stands for.
@param folder  scene folder whose copies are used (session_inputs.h); empty: the originals.
@throws Error(kNotFound, kFormat, kUsage). */
SceneInputs LoadSceneInputs(SceneConfig& config, const std::filesystem::path& folder = {});

/** Starts or resumes the scene in `folder` and writes its results. @throws Error(kInterrupted). */
OptimisedGrasp RunScene(const std::filesystem::path& folder, const SceneConfig& config,
                        const SceneInputs& inputs, TrialPool& pool, const ObserveLearning& observe);

/** Creates the folder with copies of the user's own inputs, or finds the same scene there; runs
nothing. */
void PlanScene(const std::filesystem::path& folder, const SceneConfig& config);

/** As RunScene, as a stage shown to an observer and with its trials on several workers.
@param trial_time_limit  see TrialPool. */
OptimisedGrasp RunSceneStage(const std::filesystem::path& folder, const SceneConfig& config,
                             const SceneInputs& inputs, int num_workers, Observer& observer,
                             double trial_time_limit = kTrialTimeLimit);

/** Starts or resumes one search of a comparison, from its scene's saved new pre-grasp. */
void RunComparisonSearch(const ComparisonTask& task, TrialPool& pool,
                         const ObserveLearning& observe);

/** An individual of a finished search, simulated again. */
struct ReplayedIndividual {
  Grasp grasp;  ///< id "individual-<number>"
  double stored_fitness = 0.0;
  double fitness = 0.0;
  bool is_same = false;  ///< every number of every trial is equal
};
/** Simulates an individual again. @throws Error(kNotFound) for a number that the search does not
have; kUsage when the scene is not finished. */
ReplayedIndividual ReplayIndividual(const std::filesystem::path& folder, int number,
                                    TrialPool& pool);

/** Writes the individual's grasp into the optimisation's folder. @returns the file.
@throws Error(kIo). */
std::filesystem::path SaveReplayed(const std::filesystem::path& folder,
                                   const ReplayedIndividual& replayed);

/** Default folder of an optimisation, named by its configuration, so that an equal one is
continued. */
std::filesystem::path NameSceneFolder(const SceneConfig& config, const SceneInputs& inputs);

}  // namespace graspbench
