// Any bytes as study.yaml, and as a table beside it: problems in words, never a crash.

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/base/text/data_table.h"
#include "human_study/study/design/study_config.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
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
  return 0;
}
