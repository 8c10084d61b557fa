#include "datasets/journal/file_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

// File systems without locks: tests/sessions/surroundings_test.cc.
class FileLockTest : public testing::Test {
 protected:
  FileLockTest() {
    fs::remove(path_);
    fs::remove(owner_);
  }
  int OpenAgain() const { return ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644); }
  /** What another program says when it is asked. */
  std::string AskForHolder() const {
    const int file = OpenAgain();
    const FileLock lock(file, path_);
    ::close(file);
    return lock.is_held() ? "nobody" : lock.holder();
  }

  const fs::path path_ = fs::path(testing::TempDir()) / "file_lock";
  const fs::path owner_ = fs::path(testing::TempDir()) / "file_lock.owner";
};

TEST_F(FileLockTest, BelongsToWhoOpenedTheFileFirstUntilItIsClosed) {
  const int first = OpenAgain(), second = OpenAgain();
  EXPECT_FALSE(IsLocked(path_));
  std::optional<FileLock> lock;
  lock.emplace(first, path_);
  EXPECT_TRUE(lock->is_held());
  EXPECT_TRUE(IsLocked(path_));
  EXPECT_TRUE(fs::exists(owner_));
  EXPECT_FALSE(FileLock(second, path_).is_held());
  EXPECT_TRUE(fs::exists(owner_));
  lock.reset();
  ::close(first);
  EXPECT_FALSE(fs::exists(owner_));
  EXPECT_TRUE(FileLock(second, path_).is_held());
  ::close(second);
  try {
    FileLock(-1, path_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kIo);
    EXPECT_EQ(error.what(), "cannot lock \"" + path_.string() + "\": Bad file descriptor");
  }
}

TEST_F(FileLockTest, OfAKilledProcessIsTakenOverOfAnUnknownOneItIsNot) {
  const pid_t killed = ::fork();
  if (killed == 0) {
    const FileLock lock(OpenAgain(), path_);
    ::_exit(lock.is_held() ? 7 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(killed, &status, 0), killed);
  ASSERT_EQ(WEXITSTATUS(status), 7);
  const std::string left = ReadFile(owner_);
  EXPECT_FALSE(IsLocked(path_));
  EXPECT_EQ(AskForHolder(), "nobody");

  const auto change = [&](const std::string& key, const std::string& value) {
    std::string text = left;
    const size_t begin = text.find("\"" + key + "\":") + key.size() + 3;
    const size_t end = text.find_first_of(",}", begin);
    WriteFile(owner_, text.replace(begin, end - begin, value));
  };
  const std::string rest =
      ". If that process has ended, take over with: rm \"" + owner_.string() + "\"";
  for (const auto& [key, value] :
       {std::pair("boot", "\"another\""), {"processes", "\"1\""}, {"host", "\"b\""}}) {
    change(key, value);
    const std::string holder = AskForHolder();
    EXPECT_EQ(holder.rfind("; process " + std::to_string(killed) + " of host \"", 0), 0u) << holder;
    EXPECT_NE(holder.find(rest), std::string::npos) << holder;
    EXPECT_TRUE(IsLocked(path_));
  }
  WriteFile(owner_, "half a l");
  EXPECT_EQ(AskForHolder(), "; \"" + owner_.string() + "\" does not name its owner" + rest);
  // This process lives, but one of its number that began at another time has ended.
  change("process", std::to_string(::getpid()));
  EXPECT_EQ(AskForHolder(), "nobody");
  change("process", std::to_string(::getpid()));
  RemoveLeftOwner(path_);
  EXPECT_FALSE(fs::exists(owner_));
  WriteFile(owner_, "");  // killed before it wrote
  EXPECT_EQ(AskForHolder(), "nobody");
}

}  // namespace
}  // namespace graspbench
