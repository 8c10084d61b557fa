#pragma once
/** @file
Everything that an optimisation asked of the simulation, one line a request, in the order of asking.

    {"request":57,"stage":"search","number":41,"generation":3,"parents":[12,8],"genome_rad":[..],
     "steps_rad":[..],"fitness":3.2,"trials":[{"trial_id":"..","draw":0,"sigma":3.2,..}],
     "xxh64":".."}

The optimisation is deterministic: the same answers lead to the same questions. So it is resumed by
asking again from the start and answering from the journal what is there, and a resumed journal has
the same bytes as one that was never interrupted. A line is good when its checksum is right,
whatever the lines before it are: `request` says which question it answers. What a crash has left
of a line at the end is cut off when the journal is opened for writing. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/journal/append_file.h"

namespace graspbench {

struct EvaluationRecord {
  int request = 0;  ///< the how manieth question, from 0; in older journals the line's place
  LearningStage stage = LearningStage::kStandard;
  Individual individual;  ///< of the stages that have one; `fitness` is that of the trials
  std::vector<std::string> trial_ids;
  std::vector<LearningTrial> trials;
};

std::string FormatEvaluationLine(const EvaluationRecord& record);
/** @throws Error(kFormat). */
EvaluationRecord ParseEvaluationLine(std::string_view line);

/** The good lines by `request`; a warning in `findings` for each of the others. No file: none. */
std::vector<EvaluationRecord> LoadEvaluations(const std::filesystem::path& path,
                                              Diagnostics& findings);
/** The answer to a question; null: not there. @param records  as LoadEvaluations gives them. */
const EvaluationRecord* FindEvaluation(const std::vector<EvaluationRecord>& records, int request);

class EvaluationJournal {
 public:
  /** @throws Error(kIo), also when another process writes it. */
  explicit EvaluationJournal(const std::filesystem::path& path);

  /** The stored answer to a question; null: not there. */
  const EvaluationRecord* Find(int request) const { return FindEvaluation(stored_, request); }
  /** Behind the stored ones, on the disk when it returns. */
  void Append(const std::vector<EvaluationRecord>& records);

 private:
  AppendFile file_;
  std::vector<EvaluationRecord> stored_;
};

}  // namespace graspbench
