#pragma once
/** @file
pipeline.yaml: named stages, each one of the program's own commands with its inputs and parameters.

    stages:
      benchmark:
        command: run
        inputs: {session: session.yaml}
        parameters: {trials: 3}
      judged:
        command: judge
        inputs: {folder: benchmark}

Inputs are files and folders beside the file, or stages; names from its folder, with slashes. What a
command is called, takes and needs is told by whoever knows the commands (StageCommand). */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_keys.h"

namespace graspbench {

/** Where a command puts what it makes. */
enum class StagePlace {
  kOwn,   ///< in a folder of --out
  kCopy,  ///< inside its first argument: it gets a copy of it
  kText   ///< it prints, which is kept as output.txt
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
  std::vector<StageOption> options;  ///< arguments in their order
};

struct StageInput {
  std::string option;  ///< that it is given to; empty: the command finds it by itself
  std::string path;    ///< from the pipeline's folder, or the stage and what is in its result
  std::string stage;   ///< empty: a file or folder of the user
  int line = 0;
};

struct StageParameter {
  std::string option;
  std::vector<std::string> values;  ///< none: a flag
};

struct PipelineStage {
  std::string name;
  StageCommand command;
  std::vector<StageInput> inputs;
  std::vector<StageParameter> parameters;
  int line = 0;

  /** The stages that it needs, each once, sorted. */
  std::vector<std::string> ListNeeded() const;
};

struct Pipeline {
  std::filesystem::path file;
  std::string name;    ///< of the file, without ending
  std::string folder;  ///< of the file; "." when its name has none
  std::string about;
  std::vector<PipelineStage> stages;  ///< each behind those that it needs, else as they stand

  const PipelineStage* Find(const std::string& stage) const;
};

/** The rows that the reader checks. */
const FileKeys& ListPipelineKeys();

/** No file but the text is looked at. @param file  its name in messages.
@throws Error(kFormat) with all faults and their lines. */
Pipeline ParsePipeline(const std::string& text, const std::string& file,
                       const std::vector<StageCommand>& commands);
/** With a look whether the inputs are there. @throws as ParsePipeline; Error(kNotFound, kIo). */
Pipeline LoadPipeline(const std::filesystem::path& file, const std::vector<StageCommand>& commands);

/** The folder beside the stages' results in which their inputs stand. */
inline constexpr char kStageInputs[] = "inputs";
/** What a command that prints is kept as, in its stage's folder. */
inline constexpr char kStageOutput[] = "output.txt";

/** The command's words behind "graspbench", for a process whose folder holds the results of the
stages by their names, and their inputs in `inputs`; empty: beside them. */
std::vector<std::string> ListStageWords(const PipelineStage& stage,
                                        const std::string& inputs = kStageInputs);

/** Of a command that works in a copy: what is copied, as in StageInput. @pre place is kCopy. */
std::string FindCopied(const PipelineStage& stage);

}  // namespace graspbench
