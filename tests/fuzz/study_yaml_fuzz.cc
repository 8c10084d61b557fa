// Any bytes as study.yaml, and as a table beside it: problems in words, never a crash.

#include <string>

#include "core/base/text/delimited_text.h"
#include "human_study/study/design/study_config.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  Diagnostics problems;
  const StudyConfig config = ParseStudyConfig(bytes, "fuzz", problems);
  if (problems.num_errors() == 0) {
    GRASPBENCH_DEMAND(!config.markers.tips.thumb.empty(), "a study without a thumb");
  }
  Diagnostics table_problems;
  DataTable table(bytes, "fuzz", table_problems);
  table.Require("participant");
  for (size_t row = 0; row < table.num_rows(); ++row) {
    table.Text(row, "file");
    table.Number(row, "start_s");
  }
}

}  // namespace graspbench
