#pragma once
/** @file
pipeline.yaml: named stages, each a command of the program with its inputs and parameters.

    stages:
      benchmark:
        command: run
        inputs: {session: session.yaml}
        parameters: {trials: 3}
      judged:
        command: judge
        inputs: {folder: benchmark}

Inputs are files and folders in the pipeline's folder, or stages; paths are relative to it, with
slashes. The caller provides names, options and requirements of the commands (StageCommand). */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_keys.h"

namespace graspbench {

/** Where a command puts its result. */
enum class StagePlace {
  kOwn,   ///< in the folder of --out
  kCopy,  ///< inside its first argument, of which it gets a copy
  kText   ///< on standard output, stored as output.txt
};

struct StageOption {
  std::string name;  ///< without dashes
  bool is_argument = false;
  bool takes_value = true;
  bool is_needed = false;
  bool is_own = false;  ///< set by the pipeline itself: --out, --jobs, ..
};

struct StageCommand {
  std::string name;  ///< "study run"
  StagePlace place = StagePlace::kOwn;
  std::vector<StageOption> options;  ///< arguments in order
};

struct StageInput {
  std::string option;  ///< that receives it; empty: the command finds it itself
  std::string path;    ///< relative to the pipeline's folder, or a stage and a path in its result
  std::string stage;   ///< empty: a user's file or folder
  int line = 0;
};

struct StageParameter {
  std::string option;
  std::vector<std::string> values;  ///< empty: a flag
};

struct PipelineStage {
  std::string name;
  StageCommand command;
  std::vector<StageInput> inputs;
  std::vector<StageParameter> parameters;
  int line = 0;

  /** Lists the stages that this stage needs, each once, sorted. */
  std::vector<std::string> ListNeeded() const;
};

struct Pipeline {
  std::filesystem::path file;
  std::string name;    ///< of the file, without extension
  std::string folder;  ///< of the file; "." if its path has none
  std::string about;
  std::vector<PipelineStage> stages;  ///< each after those it needs, else in the file's order

  const PipelineStage* Find(const std::string& stage) const;
};

/** The keys that the reader checks. */
const FileKeys& ListPipelineKeys();

/** Parses the text without accessing other files. @param file  its name in messages.
@throws Error(kFormat) with all faults and their lines. */
Pipeline ParsePipeline(const std::string& text, const std::string& file,
                       const std::vector<StageCommand>& commands);
/** Reads a pipeline and checks that its inputs exist. @throws as ParsePipeline; Error(kNotFound,
kIo). */
Pipeline LoadPipeline(const std::filesystem::path& file, const std::vector<StageCommand>& commands);

/** The folder next to the stages' results that holds their inputs. */
inline constexpr char kStageInputs[] = "inputs";
/** File in the stage's folder that stores the output of a printing command. */
inline constexpr char kStageOutput[] = "output.txt";

/** Returns the command line after "graspbench", for a process whose working folder holds the
stages' results by name and their inputs in `inputs` (empty: in the same folder). */
std::vector<std::string> ListStageWords(const PipelineStage& stage,
                                        const std::string& inputs = kStageInputs);

/** Returns what a command that works in a copy copies, as in StageInput. @pre place is kCopy. */
std::string FindCopied(const PipelineStage& stage);

}  // namespace graspbench
