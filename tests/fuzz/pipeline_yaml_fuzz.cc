// Any bytes as pipeline.yaml: problems in words, or stages that can run in their order.

#include <set>
#include <string>

#include "tests/datasets/pipeline/made_commands.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  try {
    const Pipeline pipeline = ParsePipeline(bytes, "fuzz", MakeCommands());
    std::set<std::string> done;
    for (const PipelineStage& stage : pipeline.stages) {
      for (const std::string& needed : stage.ListNeeded()) {
        GRASPBENCH_DEMAND(done.count(needed) > 0, needed);
      }
      GRASPBENCH_DEMAND(done.insert(stage.name).second, stage.name);
      for (const StageInput& input : stage.inputs) {
        GRASPBENCH_DEMAND(input.path.find("..") != 0 && input.path[0] != '/', input.path);
      }
      for (const std::string& word : ListStageWords(stage)) {
        GRASPBENCH_DEMAND(word.find('\n') == word.npos, word);
      }
    }
  } catch (const Error&) {
  }
}

}  // namespace graspbench
