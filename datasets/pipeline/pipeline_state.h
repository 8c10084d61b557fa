#pragma once
/** @file
What each stage was made from and what it gave, in the lock file of a folder of results, and from
that which stages are stale and because of what.

    DIR/pipeline.lock    this file: {"schema":1,"stages":{..},"sha256":".."}
    DIR/<stage>/         a stage's result
    DIR/inputs/          links to what the stages read of the user's
    DIR/logs/<stage>.txt what the command said when it ran last */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

inline constexpr char kPipelineLock[] = "pipeline.lock";
inline constexpr char kStageLogs[] = "logs";  ///< folder of what stages said

/** What a result depends on, by name: "command", "parameter trials", "input session.yaml",
"stage benchmark", "program". */
using StageFacts = std::map<std::string, std::string>;

struct LockedStage {
  StageFacts facts;
  std::map<std::string, std::string> sources;  ///< of the stages needed: hash of their results
  std::map<std::string, std::string> files;    ///< of the result, as ListStableFiles gives them
};
using PipelineLock = std::map<std::string, LockedStage>;

/** Empty when there is none. @throws Error(kFormat) when it is damaged; Error(kIo). */
PipelineLock LoadPipelineLock(const std::filesystem::path& results);
/** As a whole or not at all. @throws Error(kIo). */
void WritePipelineLock(const std::filesystem::path& results, const PipelineLock& lock);

struct StageState {
  std::string stage;
  std::vector<std::string> reasons;  ///< why it is stale, in words; none: it is fresh
  StageFacts facts;                  ///< as they are now
  bool is_edited = false;            ///< the result holds what no stage has written
  bool IsFresh() const { return reasons.empty(); }
};

/** Hash of the facts: SHA-256. */
std::string CalcStageKey(const StageFacts& facts);

/** In the pipeline's order. @param program  facts about the program itself, which all stages share.
@throws Error(kIo). */
std::vector<StageState> FindStageStates(const Pipeline& pipeline,
                                        const std::filesystem::path& results,
                                        const PipelineLock& lock, const StageFacts& program);

/** That a stage has failed, as `logs/STAGE.failed`, until it runs again.
@pre the folder of logs is there. @throws Error(kIo), std::filesystem::filesystem_error. */
void KeepFailure(const std::filesystem::path& results, const std::string& stage, int exit_code);
void ForgetFailure(const std::filesystem::path& results, const std::string& stage);

/** What the lock says of a stage that has just been made. @throws Error(kIo). */
LockedStage MakeLockedStage(const PipelineStage& stage, const StageFacts& facts,
                            const std::filesystem::path& results, const PipelineLock& lock);

}  // namespace graspbench
