#pragma once
/** @file
Commands made up for the tests of pipelines. */

#include <vector>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

inline std::vector<StageCommand> MakeCommands() {
  const StageOption out = {"out", false, true, false, true};
  return {{"make",
           StagePlace::kOwn,
           {{"file", true, true, false, false},
            {"hand", false, true, false, false},
            {"set", false, true, false, false},
            {"fast", false, false, false, false},
            {"slow", false, false, false, false},
            out}},
          {"judge", StagePlace::kCopy, {{"folder", true, true, true, false}, out}},
          {"say it",
           StagePlace::kText,
           {{"one", true, true, true, false}, {"two", true, true, false, false}}}};
}

}  // namespace graspbench
