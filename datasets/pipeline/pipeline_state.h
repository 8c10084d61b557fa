#pragma once
/** @file
Records the inputs and results of each stage in the lock file of a results folder, and determines
which stages are stale and why.

    DIR/pipeline.lock    this file: {"schema":1,"stages":{..},"sha256":".."}
    DIR/<stage>/         a stage's result
    DIR/inputs/          links to the user's files that the stages read
    DIR/logs/<stage>.txt output of the command's last run */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

inline constexpr char kPipelineLock[] = "pipeline.lock";
inline constexpr char kStageLogs[] = "logs";  ///< folder of the stages' output

/** The facts that a result depends on, by name: "command", "parameter trials", "input
session.yaml", "stage benchmark", "program". */
using StageFacts = std::map<std::string, std::string>;

struct LockedStage {
  StageFacts facts;
  std::map<std::string, std::string> sources;  ///< hash of the result of each needed stage
  std::map<std::string, std::string> files;    ///< of the result, from ListStableFiles
};
using PipelineLock = std::map<std::string, LockedStage>;

/** Loads the lock; empty if there is none. @throws Error(kFormat) when it is damaged;
Error(kIo). */
PipelineLock LoadPipelineLock(const std::filesystem::path& results);
/** Writes the lock atomically. @throws Error(kIo). */
void WritePipelineLock(const std::filesystem::path& results, const PipelineLock& lock);

struct StageState {
  std::string stage;
  std::vector<std::string> reasons;  ///< why it is stale, in words; empty: it is fresh
  StageFacts facts;                  ///< current ones
  bool is_edited = false;            ///< the result was changed by hand
  bool IsFresh() const { return reasons.empty(); }
};

/** Returns the SHA-256 of the facts. */
std::string CalcStageKey(const StageFacts& facts);

/** Determines the states in the pipeline's order.
@param program  facts about the program itself, which all stages share.
@throws Error(kIo). */
std::vector<StageState> FindStageStates(const Pipeline& pipeline,
                                        const std::filesystem::path& results,
                                        const PipelineLock& lock, const StageFacts& program);

/** Record that a stage has failed, in `logs/STAGE.failed`, and remove this record.
@pre the folder of logs exists. @throws Error(kIo), std::filesystem::filesystem_error. */
void KeepFailure(const std::filesystem::path& results, const std::string& stage, int exit_code);
void ForgetFailure(const std::filesystem::path& results, const std::string& stage);

/** Makes the lock entry of a stage that has just been run. @throws Error(kIo). */
LockedStage MakeLockedStage(const PipelineStage& stage, const StageFacts& facts,
                            const std::filesystem::path& results, const PipelineLock& lock);

}  // namespace graspbench
