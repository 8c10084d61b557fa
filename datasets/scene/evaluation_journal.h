#pragma once
/** @file
Everything that an optimisation asked of the simulation, one line a request, in the order of asking.

    {"stage":"search","number":41,"generation":3,"parents":[12,8],"genome_rad":[..],
     "steps_rad":[..],"fitness":3.2,"trials":[{"trial_id":"..","draw":0,"sigma":3.2,..}],
     "xxh64":".."}

The optimisation is deterministic: the same answers lead to the same questions. So it is resumed by
asking again from the start and answering from the journal as long as that reaches, and a resumed
journal has the same bytes as one that was never interrupted. A line is good when its checksum is
right and the lines before it are; what comes after the last good line is cut off when the journal
is opened for writing. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/journal/append_file.h"

namespace graspbench {

struct EvaluationRecord {
  LearningStage stage = LearningStage::kStandard;
  Individual individual;  ///< of the stages that have one; `fitness` is that of the trials
  std::vector<std::string> trial_ids;
  std::vector<LearningTrial> trials;
};

std::string FormatEvaluationLine(const EvaluationRecord& record);
/** @throws Error(kFormat). */
EvaluationRecord ParseEvaluationLine(std::string_view line);

/** The good lines; a warning in `findings` when there are others behind them. No file: none.
@param length  of the good lines [bytes]. */
std::vector<EvaluationRecord> LoadEvaluations(const std::filesystem::path& path,
                                              Diagnostics& findings, size_t* length = nullptr);

class EvaluationJournal {
 public:
  /** @throws Error(kIo), also when another process writes it. */
  explicit EvaluationJournal(const std::filesystem::path& path);

  /** The next stored record, from the first one on; null when all have been given. */
  const EvaluationRecord* Next();
  /** Behind the stored ones, on the disk when it returns. @pre Next gave null. */
  void Append(const std::vector<EvaluationRecord>& records);

  const Diagnostics& findings() const { return findings_; }

 private:
  AppendFile file_;
  Diagnostics findings_;
  std::vector<EvaluationRecord> stored_;
  size_t next_ = 0;
};

}  // namespace graspbench
