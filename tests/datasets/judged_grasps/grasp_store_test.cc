#include "datasets/judged_grasps/grasp_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

JudgedGrasp MakeJudged(int request) {
  JudgedGrasp judged;
  judged.request = request;
  judged.source = "a.npy";
  judged.index = request;
  judged.object = "=mug";
  judged.profile = "own";
  judged.label = "success";
  judged.result.passed = request % 2 == 0;
  judged.result.worst_shift = 0.1 * request;
  judged.result.failed_stage = judged.result.passed ? "" : "push +x";
  return judged;
}

const Json kConfig = {{"hand", "shadow"}, {"jitter", 0}};

TEST(GraspStore, WhatWasJudgedIsReadAgain) {
  const TemporaryFolder folder;
  CreateJudgedGrasps(folder.path(), kConfig);
  EXPECT_TRUE(HasJudgedGrasps(folder.path()));
  {
    GraspJournal journal(folder.path() / "journal.jsonl");
    journal.Append({MakeJudged(0), MakeJudged(1)});
  }
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(folder.path());
  ASSERT_EQ(judged.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    JudgedGrasp expected = MakeJudged(i);
    expected.search = judged[static_cast<size_t>(i)].search;
    EXPECT_EQ(JudgedGrasp::Format(judged[static_cast<size_t>(i)]), JudgedGrasp::Format(expected));
  }
  FinishJudgedGrasps(folder.path(), judged);
  const std::string table = ReadFile(folder.path() / "grasps.csv");
  EXPECT_NE(table.find("'=mug,own,0,success,1,"), std::string::npos) << table;
  EXPECT_TRUE(CheckStore(folder.path()).damages.empty());
}

TEST(GraspStore, ATornLineIsJudgedAgain) {
  const TemporaryFolder folder;
  CreateJudgedGrasps(folder.path(), kConfig);
  const fs::path path = folder.path() / "journal.jsonl";
  GraspJournal(path).Append({MakeJudged(0), MakeJudged(1)});
  const std::string whole = ReadFile(path);
  WriteFile(path, whole.substr(0, whole.size() - 20));
  GraspJournal journal(path);
  EXPECT_NE(journal.Find(0), nullptr);
  EXPECT_EQ(journal.Find(1), nullptr);
  journal.Append({MakeJudged(1)});
  EXPECT_EQ(ReadFile(path), whole);
}

TEST(GraspStore, AnotherRequestIsRefused) {
  const TemporaryFolder folder;
  CreateJudgedGrasps(folder.path(), kConfig);
  EXPECT_NO_THROW(CheckSameGrasps(folder.path(), kConfig));
  try {
    CheckSameGrasps(folder.path(), {{"hand", "tum"}, {"jitter", 0}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("hand"), std::string::npos);
  }
}

}  // namespace
}  // namespace graspbench
