#include "datasets/journal/store_sources.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/base/sha256.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/provenance.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

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

TEST_F(StoreSources, AStoreHasAHashAndAnyFileToo) {
  const std::string begun = CalcSourceSha256(folder_);
  EXPECT_EQ(begun.size(), 64u);
  Append(0, {0});
  EXPECT_NE(CalcSourceSha256(folder_), begun);
  EXPECT_EQ(CalcSourceSha256(folder_ / "plan.jsonl"), CalcSha256(ReadFile(folder_ / "plan.jsonl")));
  EXPECT_EQ(CalcSourceSha256(folder_ / "journal"), "");
  EXPECT_EQ(CalcSourceSha256(folder_ / "nothing"), "");
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
