#include "datasets/journal/append_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

// File systems without locks: tests/sessions/surroundings_test.cc.
TEST(FileLockTest, BelongsToWhoOpenedTheFileFirstUntilItIsClosed) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "file_lock";
  const auto open_again = [&] { return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644); };
  const int first = open_again(), second = open_again();
  EXPECT_EQ(LockFile(first, path), FileLock::kHeld);
  EXPECT_EQ(LockFile(second, path), FileLock::kTaken);
  ::close(first);
  EXPECT_EQ(LockFile(second, path), FileLock::kHeld);
  ::close(second);
  try {
    LockFile(-1, path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kIo);
    EXPECT_EQ(error.what(), "cannot lock \"" + path.string() + "\": Bad file descriptor");
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace graspbench
