#pragma once
/** @file
Everything that an optimisation asked of the simulation, one line a request, in the order of asking.

    {"request":57,"stage":"search","number":41,"generation":3,"parents":[12,8],"genome_rad":[..],
     "steps_rad":[..],"fitness":3.2,"trials":[{"trial_id":"..","draw":0,"sigma":3.2,..}],
     "search":"..","xxh64":".."}

Older lines have no `search`, those of before no `request` either. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/optimise/grasp_optimiser.h"
#include "datasets/scene/answer_journal.h"

namespace graspbench {

struct EvaluationRecord {
  int request = 0;  ///< the how manieth question, from 0; in older journals the line's place
  LearningStage stage = LearningStage::kStandard;
  Individual individual;  ///< of the stages that have one; `fitness` is that of the trials
  std::vector<std::string> trial_ids;
  std::vector<LearningTrial> trials;
  std::optional<std::string> search = {};

  static std::string Format(const EvaluationRecord& record);
  /** @throws Error(kFormat). */
  static EvaluationRecord Parse(std::string_view line);
};

using EvaluationJournal = AnswerJournal<EvaluationRecord>;

}  // namespace graspbench
