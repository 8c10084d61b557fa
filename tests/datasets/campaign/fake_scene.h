#pragma once
/** @file
Scenes made up for the tests of campaigns: nothing is loaded or simulated. */

#include <filesystem>
#include <vector>

#include "core/base/files/files.h"
#include "datasets/scene/scene_store.h"

namespace graspbench {

/** An evaluation journal whose sigma are as given. */
inline void WriteSearch(const std::filesystem::path& path, const std::vector<double>& fitness) {
  MakeFolder(path.parent_path());
  EvaluationJournal journal(path);
  for (size_t i = 0; i < fitness.size(); ++i) {
    EvaluationRecord record;
    record.request = static_cast<int>(i);
    record.stage = LearningStage::kSearch;
    record.individual.number = static_cast<int>(i);
    record.trial_ids = {"0123456789abcdef"};
    record.trials.resize(1);
    record.trials[0].outcome = Outcome::kSuccess;
    record.trials[0].sigma = fitness[i];
    record.trials[0].contacts = {{"TH", true, 0.4}};
    record.trials[0].closings = {0.4};
    journal.Append({record});
  }
}

/** A scene that is begun; without `fitness` nothing has been asked. */
inline void WriteScene(const std::filesystem::path& folder, const std::string& object,
                       const std::vector<double>& fitness, bool is_finished) {
  SceneConfig config;
  config.hand = "tum";
  config.object = object;
  config.grasp = "g1";
  CreateScene(folder, config);
  if (!fitness.empty()) WriteSearch(folder / "journal.jsonl", fitness);
  if (!is_finished) return;
  WriteFile(folder / "result.json", "{}\n");
  SealStore(kSceneStore, folder, "0123456789abcdef");
}

}  // namespace graspbench
