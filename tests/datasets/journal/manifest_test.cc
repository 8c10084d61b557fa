#include "datasets/journal/manifest.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/ro_crate.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

namespace fs = std::filesystem;

std::string MakeLine(const char* id) { return FormatCheckedLine({{"trial_id", id}}) + "\n"; }
const std::string kLines = MakeLine("one") + MakeLine("two") + MakeLine("three");

class ManifestFolder : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    MakeFolder(folder_ / "journal");
    WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
    WriteFile(folder_ / "journal/0.jsonl", kLines);
    Manifest manifest;
    manifest.kind = "session";
    manifest.versions = {{"schema", 4}};
    manifest.files = {SealJournal(folder_, "journal/0.jsonl", false),
                      SealFile(folder_, "session.json")};
    WriteManifest(folder_, manifest);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /** "" when nothing is wrong; the manifest's own damage counts. */
  std::string Look() const {
    try {
      return FormatDamage(FindDamage(folder_, LoadManifest(folder_)));
    } catch (const Error& e) {
      return e.what();
    }
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("manifest_" + std::to_string(::getpid()));
};

TEST_F(ManifestFolder, VouchesForWhatItHasSeen) {
  EXPECT_EQ(Look(), "");
  const Manifest manifest = LoadManifest(folder_);
  EXPECT_EQ(manifest.kind, "session");
  EXPECT_EQ(manifest.versions.at("schema"), 4);
  EXPECT_EQ(manifest.files[0].lines, 3);
}

TEST_F(ManifestFolder, EveryBitOfEveryFileCounts) {
  for (const char* path : {"session.json", "journal/0.jsonl", "manifest.json"}) {
    const std::string whole = ReadFile(folder_ / path);
    for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string flipped = whole;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      WriteFile(folder_ / path, flipped);
      ASSERT_NE(Look(), "") << path << ", bit " << bit;
    }
    WriteFile(folder_ / path, whole);
  }
  EXPECT_EQ(Look(), "");
}

TEST_F(ManifestFolder, CutsAreFoundAtEveryLength) {
  for (const char* path : {"session.json", "journal/0.jsonl", "manifest.json"}) {
    const std::string whole = ReadFile(folder_ / path);
    for (size_t length = 0; length < whole.size(); ++length) {
      WriteFile(folder_ / path, whole.substr(0, length));
      ASSERT_NE(Look(), "") << path << " cut to " << length;
    }
    WriteFile(folder_ / path, whole);
  }
}

TEST_F(ManifestFolder, AMissingFileAndSwappedLinesAreNamed) {
  fs::remove(folder_ / "session.json");
  EXPECT_EQ(Look(), "\n  session.json: is missing");
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
  WriteFile(folder_ / "journal/0.jsonl", MakeLine("two") + MakeLine("one") + MakeLine("three"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl: its committed lines have changed");
  WriteFile(folder_ / "journal/0.jsonl", MakeLine("one") + "{\"damaged\"}\n");
  EXPECT_EQ(Look(),
            "\n  journal/0.jsonl: has 58 bytes and 2 lines; 140 bytes and 3 lines were committed\n "
            " journal/0.jsonl:2: the line is truncated or not a record");
}

TEST_F(ManifestFolder, AJournalMayGrowByWholeLinesAndAFileMayNot) {
  WriteFile(folder_ / "journal/0.jsonl", kLines + MakeLine("four") + "{\"fi");
  EXPECT_EQ(Look(), "");
  EXPECT_EQ(SealJournal(folder_, "journal/0.jsonl", false).lines, 4);
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"fi\n" + MakeLine("four"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl:4: the line is truncated or not a record");
  WriteFile(folder_ / "journal/0.jsonl", kLines);
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n\n");
  EXPECT_EQ(Look(), "\n  session.json: has more than 11 bytes");
}

// A crash tears a line, the next run commits it as it is and goes on behind a line break.
TEST_F(ManifestFolder, ATornLineThatWasCommittedIsNoDamageUnlessItIsContinued) {
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to");
  Manifest manifest = LoadManifest(folder_);
  manifest.files[0] = SealJournal(folder_, "journal/0.jsonl", true);
  WriteManifest(folder_, manifest);
  EXPECT_EQ(Look(), "");
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to\n" + MakeLine("four"));
  EXPECT_EQ(Look(), "");
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to" + MakeLine("four"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl:4: a torn line was continued");
}

TEST_F(ManifestFolder, AJournalWithoutAWholeLineIsEmpty) {
  WriteFile(folder_ / "journal/0.jsonl", "torn");
  const ManifestFile sealed = SealJournal(folder_, "journal/0.jsonl", false);
  EXPECT_EQ(sealed.lines, 0);
  EXPECT_EQ(sealed.bytes, 0u);
}

class StoreSources : public testing::Test {
 protected:
  StoreSources() : plan_(CreateFakeSession(folder_, 2)) {}

  void Append(int worker, const std::vector<size_t>& trials) {
    JournalWriter writer(folder_, worker);
    for (const size_t trial : trials) writer.Append(MakeFakeRecord(plan_[trial]));
  }
  std::string Hash() const { return CalcJournalSha256(folder_, "journal/*.jsonl"); }
  std::vector<std::string> ListStale() const {
    std::vector<std::string> stale;
    for (const StaleResult& one : CheckStore(folder_).stale) {
      stale.push_back(one.path + " " + one.input);
    }
    return stale;
  }

  TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path() / "s";
  std::vector<PlannedTrial> plan_;
};

TEST_F(StoreSources, AJournalCountsByItsLinesWhoeverWroteThem) {
  Append(0, {0, 1, 2});
  const std::string one = Hash();
  fs::remove(folder_ / "journal" / "0.jsonl");
  Append(0, {2, 0});
  EXPECT_NE(Hash(), one);
  Append(1, {1, 0});  // the same trial twice is the same
  EXPECT_EQ(Hash(), one);
  std::string torn = ReadFile(folder_ / "journal" / "1.jsonl");
  WriteFile(folder_ / "journal" / "1.jsonl", torn + torn.substr(0, 20));
  EXPECT_EQ(Hash(), one);
}

// sort and sha256sum say the same: the definition has no secrets.
TEST_F(StoreSources, TheHashIsThatOfTheSortedHashesOfTheLines) {
  Append(0, {0, 1});
  std::string lines = ReadFile(folder_ / "journal" / "0.jsonl");
  std::string first = CalcSha256(lines.substr(0, lines.find('\n'))),
              second = CalcSha256(
                  lines.substr(lines.find('\n') + 1, lines.size() - lines.find('\n') - 2));
  if (second < first) std::swap(first, second);
  EXPECT_EQ(Hash(), CalcSha256(first + "\n" + second + "\n"));
}

TEST_F(StoreSources, AnExportIsStaleWhenAnyOfItsSourcesChanges) {
  Append(0, {0, 1});
  SealStore(kSessionStore, folder_);
  ExportSession(folder_, LoadSession(folder_));
  EXPECT_TRUE(ListStale().empty());
  Append(1, {2});
  SealStore(kSessionStore, folder_);
  EXPECT_EQ(ListStale(), std::vector<std::string>{"export ../journal/*.jsonl"});
  ExportSession(folder_, LoadSession(folder_));
  EXPECT_TRUE(ListStale().empty());
  WriteFile(folder_ / "plan.jsonl", ReadFile(folder_ / "plan.jsonl") + " ");
  EXPECT_EQ(ListStale(), std::vector<std::string>{"export ../plan.jsonl"});
}

// An experiment that came after a page was written makes it stale as one that has gone on does.
TEST_F(StoreSources, AStoreThatIsNewIsAChangeOfItsPattern) {
  const fs::path output = folder_ / "report";
  MakeFolder(output);
  WriteFile(output / "index.html", "page");
  const std::vector<std::string> shown = {"journal/*.jsonl", "sensitivity/*"};
  const auto seal = [&] {
    SealOutput(output, {"index.html"}, MakeOutputOrigin(folder_, "graspbench report .", shown));
  };
  seal();
  EXPECT_TRUE(ListStale().empty());
  CreateFakeSession(folder_ / "sensitivity" / "0a", 1);
  EXPECT_EQ(ListStale(), std::vector<std::string>{"report ../sensitivity/*"});
  seal();
  EXPECT_TRUE(ListStale().empty());
  CreateFakeSession(folder_ / "numerics" / "0b", 1);  // is not shown
  EXPECT_TRUE(ListStale().empty());
  JournalWriter(folder_ / "sensitivity" / "0a", 0).Append(MakeFakeRecord(plan_[0]));
  EXPECT_EQ(ListStale(), std::vector<std::string>{"report ../sensitivity/0a"});
}

TEST_F(StoreSources, WhatWasMovedAwaySaysNothing) {
  Append(0, {0});
  const fs::path result = temporary_.path() / "result";
  MakeFolder(result);
  ManifestOrigin origin = MakeOrigin("graspbench replay");
  origin.inputs = {{"../s", CalcSourceSha256(folder_)}, {"elsewhere.c3d", "abc"}};
  EXPECT_TRUE(FindChangedSources(result, origin).empty());
  Append(1, {1});
  EXPECT_EQ(FindChangedSources(result, origin), std::vector<std::string>{"../s"});
  fs::rename(folder_, temporary_.path() / "moved");
  EXPECT_TRUE(FindChangedSources(result, origin).empty());
}

}  // namespace

}  // namespace graspbench
