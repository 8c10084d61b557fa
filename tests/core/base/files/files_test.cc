#include "core/base/files/files.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::filesystem::path Temporary() { return testing::TempDir(); }

TEST(Files, AFileWrittenWithoutWaitingIsReplacedWhole) {
  const std::filesystem::path path = Temporary() / "quick";
  WriteFile(path, "a longer text");
  WriteFile(path, "short");
  EXPECT_EQ(ReadFile(path), "short");
  EXPECT_NO_THROW(SyncFileSystem(Temporary()));
}

TEST(Files, APartOfAKilledProcessIsRemovedAndThatOfALivingOneIsNot) {
  const std::filesystem::path folder = Temporary() / "parts";
  std::filesystem::remove_all(folder);
  MakeFolder(folder);
  const std::string path = (folder / "results").string();
  const pid_t dead = ::fork();
  if (dead == 0) {  // the system kills it in the middle of the file
    const struct rlimit one_byte = {1, 1};
    ::setrlimit(RLIMIT_FSIZE, &one_byte);
    WriteFileAtomically(path, "more than a byte");
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(dead, &status, 0), dead);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::string left = std::filesystem::directory_iterator(folder)->path().string();
  const std::string id = ".part" + std::to_string(dead);
  ASSERT_NE(left.find(id), std::string::npos) << left;
  const std::string realm = left.substr(left.find(id) + id.size());

  const std::string busy = path + ".part" + std::to_string(::getppid()) + realm;
  const std::string elsewhere = path + id + "-00000000-0123456789abcdef";
  const std::string other = path + ".partial";
  for (const std::string& file : {busy, elsewhere, other}) WriteFile(file, "half");
  WriteFileAtomically(path, "whole");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(busy));
  EXPECT_TRUE(std::filesystem::exists(elsewhere));
  EXPECT_TRUE(std::filesystem::exists(other));
}

// Who may write into the folder could put a link there, were the name known before.
TEST(Files, NobodyKnowsTheNameOfATemporaryFileBefore) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "temporary";
  std::set<std::string> names;
  for (int i = 0; i < 3; ++i) {
    std::filesystem::remove_all(folder);
    MakeFolder(folder);
    const AtomicFile file(folder / "results");
    const auto entry = std::filesystem::directory_iterator(folder);
    names.insert(entry->path().filename().string());
    EXPECT_EQ(names.begin()->rfind("results.part", 0), 0u) << *names.begin();
  }
  EXPECT_EQ(names.size(), 3u);
}

TEST(Files, LongNamesAreShortenedToDifferentOnes) {
  EXPECT_EQ(ShortenName(std::string(200, 'a')), std::string(200, 'a'));
  const std::string a = ShortenName(std::string(254, 'a') + "b");
  EXPECT_EQ(a.size(), 200u);
  EXPECT_NE(a, ShortenName(std::string(254, 'a') + "c"));
  std::string letters;  // of two bytes, at odd places
  for (letters = "a"; letters.size() < 255;) letters += "\u00e4";
  const std::string b = ShortenName(letters);
  EXPECT_EQ(letters.compare(0, b.find('~'), b, 0, b.find('~')), 0);
  EXPECT_EQ(b.find('~') % 2, 1u) << "no letter is cut";
}

TEST(Files, AStreamReadsWhatTheFileHolds) {
  const std::string path = testing::TempDir() + "/stream";
  std::string content;
  for (int i = 0; i < 40000; ++i) content += std::to_string(i) + "\n";
  WriteFile(path, content);
  const std::unique_ptr<std::istream> stream = OpenStream(path);
  std::string number;
  stream->seekg(100000);
  EXPECT_EQ(stream->get(), content[100000]);
  EXPECT_EQ(stream->tellg(), std::streampos(100001));
  stream->seekg(-6, std::ios::end);
  *stream >> number;
  EXPECT_EQ(number, "39999");
  stream->seekg(0);
  std::string all((std::istreambuf_iterator<char>(*stream)), {});
  EXPECT_EQ(all, content);
  EXPECT_EQ(stream->get(), EOF);
  stream->clear();
  stream->seekg(0, std::ios::end);
  EXPECT_EQ(stream->tellg(), std::streampos(static_cast<std::streamoff>(content.size())));
  EXPECT_THROW(OpenStream(testing::TempDir()), Error);
}

TEST(Files, AnUnwritablePlaceGivesTheSystemsReason) {
  for (const auto write : {WriteFile, WriteFileAtomically}) {
    try {
      write("/proc/none/file", "x");
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kIo);
      EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
    }
  }
}

// Without a home the cache must not lie where anybody could have prepared it.
TEST(Files, TheCacheHasAHome) {
  const auto with = [](const char* cache, const char* home) {
    ::setenv("XDG_CACHE_HOME", cache, 1);
    ::setenv("HOME", home, 1);
    return FindCacheRoot().string();
  };
  EXPECT_EQ(with("/somewhere", "/home/me"), "/somewhere/graspbench");
  EXPECT_EQ(with("", "/home/me"), "/home/me/.cache/graspbench");
  EXPECT_EQ(with("relative", "/home/me"), "/home/me/.cache/graspbench");
  const std::filesystem::path own =
      std::filesystem::temp_directory_path() / ("graspbench-" + std::to_string(::geteuid()));
  EXPECT_EQ(with("", ""), own.string());
  EXPECT_TRUE(IsPrivateFolder(own));
}

TEST(Files, ACacheBehindALinkIsNotUsed) {
  const std::filesystem::path place = Temporary() / "cache_place";
  std::filesystem::create_directories(place / "of_somebody");
  std::filesystem::create_directory_symlink(place / "of_somebody",
                                            place / ("graspbench-" + std::to_string(::geteuid())));
  ::setenv("TMPDIR", place.c_str(), 1);
  ::setenv("XDG_CACHE_HOME", "", 1);
  ::setenv("HOME", "", 1);
  EXPECT_EQ(FindCacheRoot(), "/dev/null/graspbench");
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(place / "of_somebody"));
}

TEST(Files, PrivateFoldersAreTheirOwnersAlone) {
  const std::filesystem::path folder = Temporary() / "private" / "inner";
  MakePrivateFolder(folder);
  EXPECT_TRUE(IsPrivateFolder(folder));
  EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all);
  std::filesystem::permissions(folder, std::filesystem::perms::group_write,
                               std::filesystem::perm_options::add);
  EXPECT_FALSE(IsPrivateFolder(folder));
  MakePrivateFolder(folder);
  EXPECT_TRUE(IsPrivateFolder(folder));

  WriteFile(folder / "file", "");
  EXPECT_FALSE(IsPrivateFolder(folder / "file"));
  EXPECT_FALSE(IsPrivateFolder(folder / "none"));
  EXPECT_THROW(MakePrivateFolder(folder / "file"), Error);
}

TEST(Files, MakesAndSyncsFolders) {
  MakeFolder(Temporary() / "a" / "b");
  MakeFolder(Temporary() / "a" / "b");
  SyncFolder(Temporary() / "a");
  EXPECT_TRUE(std::filesystem::is_directory(Temporary() / "a" / "b"));
  try {
    SyncFolder(Temporary() / "a" / "none");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kIo);
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
  }
}

TEST(FilePieces, AreTheFileAndStopWhenNoMoreIsWanted) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "pieces";
  std::string content;
  for (int i = 0; i < 200000; ++i) content += std::to_string(i);
  WriteFile(path, content);
  std::string read;
  int num_pieces = 0;
  ReadPieces(path, [&](std::string_view piece) {
    ++num_pieces;
    read += piece;
    return true;
  });
  EXPECT_TRUE(read == content);
  EXPECT_GT(num_pieces, 2);
  ReadPieces(path, [&](std::string_view) {
    --num_pieces;
    return num_pieces > 2;
  });
  EXPECT_EQ(num_pieces, 2);
}

TEST(FilePieces, RefusesWhatIsNoFile) {
  const auto ignore = [](std::string_view) { return true; };
  EXPECT_THROW(ReadPieces("/dev/zero", ignore), Error);
  EXPECT_THROW(ReadPieces(testing::TempDir(), ignore), Error);
  EXPECT_THROW(ReadPieces("no/such/file", ignore), Error);
}

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("atomic_files_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  size_t CountFiles() const {
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(AtomicFiles, PiecesOfAnySizeAreThereInTheirOrderOnlyAfterCommit) {
  const fs::path path = folder_ / "table.csv";
  WriteFile(path, "old");
  std::string whole;
  {
    AtomicFile file(path);
    for (const size_t size : {1, 70000, 0, 3, 65535, 65536, 2}) {
      const std::string piece(size, static_cast<char>('a' + whole.size() % 26));
      file.Write(piece);
      whole += piece;
    }
    EXPECT_EQ(ReadFile(path), "old");
    file.Commit();
  }
  EXPECT_TRUE(ReadFile(path) == whole);
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_F(AtomicFiles, NothingIsLeftWithoutCommit) {
  { AtomicFile(folder_ / "table.csv").Write("half"); }
  EXPECT_EQ(CountFiles(), 0u);
}

// Killed while it wrote, its parent gone or slow: nobody has asked about its end yet.
TEST_F(AtomicFiles, WhatAnEndedProcessLeftIsRemovedAlsoBeforeItsParentAsks) {
  const fs::path path = folder_ / "table.csv";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    new AtomicFile(path);  // as after a kill, nothing tidies up
    ::_exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  ASSERT_EQ(CountFiles(), 1u) << "the part of the process that has ended";
  ASSERT_EQ(::kill(child, 0), 0) << "its number is still its own";
  {
    AtomicFile file(path);
    file.Commit();
  }
  EXPECT_EQ(CountFiles(), 1u);
  EXPECT_TRUE(fs::exists(path));
  ::waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace graspbench
