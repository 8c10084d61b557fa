#include "workbench/experiments/output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class OutputFolderTest : public testing::Test {
 protected:
  OutputFolderTest()
      : top_(fs::path(testing::TempDir()) / ("output_folder_" + std::to_string(::getpid()))) {
    fs::remove_all(top_);
    fs::create_directories(top_);
  }
  ~OutputFolderTest() override { fs::remove_all(top_); }

  /** Writes a result with one page. */
  void WriteResult(const std::string& page, bool replace) {
    StagedFolder staged({top_ / "out", "basin", replace, {}});
    WriteFileAtomically(staged.path() / "index.html", page);
    MakeFolder(staged.path() / "data");
    WriteFileAtomically(staged.path() / "data" / (page + ".csv"), page);
    staged.Commit();
  }
  std::string FindFault(bool replace = true, const char* kind = "basin") {
    try {
      CheckOutputFolder({top_ / "out", kind, replace, {}});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      return error.what();
    }
    return "";
  }
  size_t CountEntries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(top_), {}));
  }

  fs::path top_;
};

TEST_F(OutputFolderTest, ANewResultAppearsWholeOrNotAtAll) {
  {
    StagedFolder staged({top_ / "out", "basin", false, {}});
    WriteFileAtomically(staged.path() / "index.html", "half");
    EXPECT_FALSE(fs::exists(top_ / "out"));
  }
  EXPECT_EQ(CountEntries(), 0u);
  WriteResult("one", false);
  EXPECT_EQ(ReadFile(top_ / "out" / "index.html"), "one");
  EXPECT_EQ(CountEntries(), 1u);
}

TEST_F(OutputFolderTest, WhatItsOwnScriptsWroteGoesWithTheOldResult) {
  WriteResult("one", false);
  WriteFileAtomically(top_ / "out" / "data" / "answers.csv", "by a script");
  EXPECT_NE(FindFault().find("data/answers.csv"), std::string::npos);
  OutputRequest request = {top_ / "out", "basin", true, {}, "", {"data/answers.csv"}};
  CheckOutputFolder(request);
  WriteFileAtomically(top_ / "out" / "data" / "other.csv", "by a person");
  EXPECT_THROW(CheckOutputFolder(request), Error);
}

TEST_F(OutputFolderTest, ReplacesOnlyWhenAskedAndLeavesNothingOfTheOld) {
  WriteResult("one", false);
  EXPECT_NE(FindFault(false).find("--replace"), std::string::npos);
  EXPECT_THROW(WriteResult("two", false), Error);
  WriteResult("two", true);
  EXPECT_EQ(ReadFile(top_ / "out" / "index.html"), "two");
  EXPECT_FALSE(fs::exists(top_ / "out" / "data" / "one.csv"));
  EXPECT_EQ(CountEntries(), 1u);
}

TEST_F(OutputFolderTest, RefusesWhatIsNotAsItWasWritten) {
  WriteResult("one", false);
  EXPECT_EQ(FindFault(), "");
  EXPECT_NE(FindFault(true, "study").find("no earlier study"), std::string::npos);

  WriteFileAtomically(top_ / "out" / "data" / "notes.txt", "mine");
  EXPECT_NE(FindFault().find("data/notes.txt"), std::string::npos);
  fs::remove(top_ / "out" / "data" / "notes.txt");
  EXPECT_EQ(FindFault(), "");

  WriteFileAtomically(top_ / "out" / "index.html", "my own words");
  EXPECT_NE(FindFault().find("index.html"), std::string::npos);
  WriteFileAtomically(top_ / "out" / "index.html", "one");
  EXPECT_EQ(FindFault(), "");

  fs::create_symlink("/etc/passwd", top_ / "out" / "link");
  EXPECT_NE(FindFault().find("link"), std::string::npos);
}

TEST_F(OutputFolderTest, WhatComesInTheWayMeanwhileIsKept) {
  StagedFolder staged({top_ / "out", "basin", false, {}});
  fs::create_directory(top_ / "out");
  WriteFileAtomically(top_ / "out" / "mine.txt", "mine");
  EXPECT_THROW(staged.Commit(), Error);
  EXPECT_EQ(ReadFile(top_ / "out" / "mine.txt"), "mine");
}

TEST_F(OutputFolderTest, RefusesTheFolderOfAnInput) {
  fs::create_directories(top_ / "out" / "deep");
  WriteFileAtomically(top_ / "out" / "deep" / "study.yaml", "x");
  EXPECT_THROW(CheckOutputFolder({top_ / "out", "study", true, {top_ / "out" / "deep"}}), Error);
  EXPECT_NO_THROW(
      CheckOutputFolder({top_ / "out" / "deep" / "new", "study", true, {top_ / "out" / "deep"}}));
}

// What a killed program left is removed, what another one is writing is not.
TEST_F(OutputFolderTest, RemovesOnlyWhatIsAbandoned) {
  fs::create_directory(top_ / ".out.part-1");
  WriteFileAtomically(top_ / ".out.part-1" / ".lock", "");
  fs::create_directory(top_ / ".out.part-2");  // no lock in it: nobody's business
  WriteFileAtomically(top_ / ".out.part-2" / "notes.txt", "");
  fs::create_directory(top_ / ".out.part-3");  // killed before its lock or after it
  fs::create_directory(top_ / ".out.part-4.old");
  WriteFileAtomically(top_ / ".out.part-4.old" / ".lock", "");
  StagedFolder first({top_ / "out", "basin", false, {}});
  EXPECT_FALSE(fs::exists(top_ / ".out.part-1"));
  EXPECT_TRUE(fs::exists(top_ / ".out.part-2"));
  EXPECT_FALSE(fs::exists(top_ / ".out.part-3"));
  EXPECT_TRUE(fs::exists(top_ / ".out.part-4.old")) << "the only copy of an older result";
  const StagedFolder second({top_ / "out", "basin", false, {}});
  EXPECT_NE(first.path(), second.path());
  EXPECT_TRUE(fs::exists(first.path()));
}

TEST_F(OutputFolderTest, WhatIsCopiedHoldsNoResultOfItself) {
  fs::create_directory(top_ / "hand");
  fs::create_directory_symlink("hand", top_ / "link");
  EXPECT_THROW(CheckOutside(top_ / "hand", top_ / "hand"), Error);
  EXPECT_THROW(CheckOutside(top_ / "hand" / "new", top_ / "hand"), Error);
  EXPECT_THROW(CheckOutside(top_ / "link" / "new", top_ / "hand"), Error);
  EXPECT_NO_THROW(CheckOutside(top_ / "hand2", top_ / "hand"));
  EXPECT_NO_THROW(CheckOutside(top_ / "hand" / ".." / "new", top_ / "hand"));
  EXPECT_NO_THROW(CheckOutside(top_, top_ / "hand"));
}

TEST_F(OutputFolderTest, AFileIsWrittenOnlyWhereNoneIs) {
  EXPECT_THROW(CheckOutputFile(""), Error);
  EXPECT_THROW(CheckOutputFile(top_), Error);
  EXPECT_THROW(CheckOutputFile(top_ / "new.csv" / ""), Error) << "a slash makes it a folder's name";
  EXPECT_NO_THROW(CheckOutputFile(top_ / "new.csv"));
  WriteFileAtomically(top_ / "old.csv", "x");
  EXPECT_THROW(CheckOutputFile(top_ / "old.csv"), Error);
  fs::create_symlink("nothing", top_ / "dangling");
  EXPECT_THROW(CheckOutputFile(top_ / "dangling"), Error);
  EXPECT_THROW(CheckOutputFile(top_ / "old.csv" / "new" / "new.csv"), Error);
  EXPECT_NO_THROW(CheckOutputFile(top_ / "new" / "new.csv"));
}

// The only things in a result's folder are the result's own.
TEST_F(OutputFolderTest, NothingElseIsWrittenIntoAResult) {
  WriteResult("one", false);
  fs::create_directories(top_ / "session" / "report");
  WriteFileAtomically(top_ / "session" / "session.json", "{}");
  for (const char* inside : {"out/new.csv", "out/data/new.csv", "out/deep/new/new.csv",
                             "session/new.csv", "session/report/new.csv"}) {
    EXPECT_THROW(CheckOutputFile(top_ / inside), Error) << inside;
    EXPECT_THROW(CheckOutsideResults(top_ / inside), Error) << inside;
  }
  EXPECT_NO_THROW(CheckOutputFile(top_ / "beside.csv"));
  EXPECT_NO_THROW(CheckOutsideResults(top_ / "out")) << "the result itself may be replaced";
  EXPECT_NO_THROW(CheckOutputFolder({top_ / "session" / "scenes" / "a", "", false, {}}))
      << "a result may have results of its own in it";
}

TEST_F(OutputFolderTest, AFileIsWrittenWithTheFoldersThatItNeeds) {
  WriteOutputFile(top_ / "new" / "place" / "a.csv", "x");
  EXPECT_EQ(ReadFile(top_ / "new" / "place" / "a.csv"), "x");
  EXPECT_THROW(WriteOutputFile(top_ / "new" / "place" / "a.csv", "y"), Error);
}

}  // namespace
}  // namespace graspbench
