#include "datasets/pipeline/stable_files.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/journal/sealed_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/pipeline/made_commands.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {
namespace fs = std::filesystem;

class StableFiles : public testing::Test {
 protected:
  void Append(const fs::path& folder, const std::vector<PlannedTrial>& plan, int worker,
              const std::vector<size_t>& trials) const {
    JournalWriter writer(folder, worker);
    for (const size_t trial : trials) writer.Append(MakeFakeRecord(plan[trial]));
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path();
};

TEST_F(StableFiles, OfAPlainFolderEveryFileCounts) {
  MakeFolder(top_ / "a" / "progress");
  WriteFile(top_ / "a" / "run.json", "abc");
  WriteFile(top_ / "a" / "progress" / "x", "");
  WriteFile(top_ / "a" / "x.part12-0123abcd-0123456789abcdef", "left by a killed process");
  WriteFile(top_ / "a" / "x.part", "a file of this name");
  const auto files = ListStableFiles(top_ / "a");
  ASSERT_EQ(files.size(), 3u);
  // FIPS 180-4's own example.
  EXPECT_EQ(files.at("run.json"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(files.count("progress/x"), 1u);
  EXPECT_EQ(files.count("x.part"), 1u);
  EXPECT_EQ(ListStableFiles(top_ / "a" / "run.json").at("run.json"), files.at("run.json"));
}

TEST_F(StableFiles, AStoreIsTheSameWhoeverMadeIt) {
  const auto plan = CreateFakeSession(top_ / "a" / "s", 2);
  Append(top_ / "a" / "s", plan, 0, {0, 1, 2});
  CreateFakeSession(top_ / "b" / "s", 2);
  Append(top_ / "b" / "s", plan, 0, {2});
  Append(top_ / "b" / "s", plan, 1, {1, 0, 2});
  SealStore(kSessionStore, top_ / "a" / "s");
  WriteFile(top_ / "a" / "s" / "run.json", "a clock");
  MakeFolder(top_ / "b" / "s" / "workers");
  WriteFile(top_ / "b" / "s" / "workers" / "0.jsonl", "a host");
  EXPECT_EQ(ListStableFiles(top_ / "a"), ListStableFiles(top_ / "b"));
  EXPECT_EQ(ListStableFiles(top_ / "a").count("s/journal/*.jsonl"), 1u);

  CopyStableFiles(top_ / "a", top_ / "copy_a");
  CopyStableFiles(top_ / "b", top_ / "copy_b");
  for (const char* file : {"s/journal/0.jsonl", "s/manifest.json", "s/plan.jsonl"}) {
    EXPECT_EQ(ReadFile(top_ / "copy_a" / file), ReadFile(top_ / "copy_b" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(top_ / "copy_a" / "s" / "run.json"));
  EXPECT_FALSE(fs::exists(top_ / "copy_b" / "s" / "workers"));
  // The copy is a store that every reader opens, and the same again.
  EXPECT_EQ(LoadSession(top_ / "copy_b" / "s").records.size(), 3u);
  EXPECT_TRUE(CheckStore(top_ / "copy_b" / "s").damages.empty());
  EXPECT_EQ(ListStableFiles(top_ / "copy_b"), ListStableFiles(top_ / "b"));

  Append(top_ / "b" / "s", plan, 0, {3});
  EXPECT_NE(ListStableFiles(top_ / "a"), ListStableFiles(top_ / "b"));
}

TEST_F(StableFiles, AManifestThatNobodyCanReadIsAnEdit) {
  CreateFakeSession(top_ / "a", 1);
  SealStore(kSessionStore, top_ / "a");
  const auto whole = ListStableFiles(top_ / "a");
  EXPECT_EQ(whole.at("manifest.json"), "whole");
  WriteFile(top_ / "a" / "manifest.json", "garbage");
  EXPECT_NE(ListStableFiles(top_ / "a"), whole);
  fs::remove(top_ / "a" / "manifest.json");
  EXPECT_EQ(ListStableFiles(top_ / "a").count("manifest.json"), 0u);
}

TEST_F(StableFiles, LinksAndPipesAreTold) {
  MakeFolder(top_ / "a");
  fs::create_symlink("nowhere", top_ / "a" / "link");
  EXPECT_EQ(ListStableFiles(top_ / "a").at("link"), "no file");
  EXPECT_THROW(ListStableFiles(top_ / "nowhere"), Error);
}

class HiddenInputs : public testing::Test {
 protected:
  HiddenInputs() {
    MakeFolder(top_ / "here" / "mine");
    MakeFolder(top_ / "away");
    WriteFile(top_ / "here" / "p.yaml", "stages: {a: {command: make, inputs: {file: s.yaml}}}\n");
  }

  /** What loading the pipeline says to a session file; empty: nothing. */
  std::string Load(const std::string& session) {
    WriteFile(top_ / "here" / "s.yaml", session);
    try {
      LoadPipeline(top_ / "here" / "p.yaml", MakeCommands());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path();
};

TEST_F(HiddenInputs, WhatLeadsOutOfThePipelineIsRefusedAtItsLine) {
  const std::string away = (top_ / "away").string();
  const std::string message = Load("trials: 1\nobjects:\n  - can\n  - " + away + "\n");
  EXPECT_TRUE(Has(message, "s.yaml:4"));
  EXPECT_TRUE(Has(message, "stage a would read \"" + away + "\""));
  EXPECT_NE(Load("objects: [../away]\n"), "");
  EXPECT_NE(Load("deep: {er: [{still: ../away}]}\n"), "");
}

TEST_F(HiddenInputs, WhatStaysInsideOrLeadsNowhereIsLeftToTheCommand) {
  EXPECT_EQ(Load("objects: [can, mine, inputs/mine, ../nowhere, /nowhere/at/all]\n"), "");
  EXPECT_EQ(Load("broken: [\n"), "");  // which the command tells better
  EXPECT_EQ(Load(""), "");
}

}  // namespace

}  // namespace graspbench
