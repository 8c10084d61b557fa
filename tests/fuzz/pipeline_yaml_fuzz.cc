// Any bytes as pipeline.yaml: problems in words, or stages that can run in their order.

#include <cstdint>
#include <set>
#include <string>

#include "tests/datasets/pipeline/made_commands.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  try {
    const Pipeline pipeline =
        ParsePipeline({reinterpret_cast<const char*>(data), size}, "fuzz", MakeCommands());
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
  return 0;
}
