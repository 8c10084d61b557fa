#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/files/files.h"
#include "tests/fuzz/fuzz_session.h"

namespace graspbench {
namespace {

/** Feeds every file of tests/fuzz/cases/<what>; a find shows as a crash. */
template <class Fuzz>
void Replay(const char* what, Fuzz&& fuzz) {
  int num_cases = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(GRASPBENCH_FUZZ_CASES) / what)) {
    SCOPED_TRACE(entry.path().filename().string());
    fuzz(ReadFile(entry.path()));
    ++num_cases;
  }
  EXPECT_GE(num_cases, 5);
}

TEST(FuzzReplay, JournalLine) { Replay("journal_line", FuzzJournalLine); }
TEST(FuzzReplay, SessionYaml) { Replay("session_yaml", FuzzSessionYaml); }

}  // namespace
}  // namespace graspbench
