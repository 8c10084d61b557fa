#include "workbench/folder_status.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/scene/development_store.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(FolderStatus, CountsWhatIsFinished) {
  const TemporaryFolder folder;
  const std::vector<PlannedTrial> plan = CreateFakeSession(folder.path() / "s", 2);
  const auto read = [&] { return ReadFolderStatus(folder.path() / "s", 600.0); };
  const int num_all = static_cast<int>(plan.size());
  EXPECT_EQ(read().num_done, 0);
  EXPECT_EQ(read().num_all, num_all);
  EXPECT_FALSE(read().is_finished);
  {
    JournalWriter journal(folder.path() / "s", 0);
    journal.Append(MakeFakeRecord(plan[0]));
  }
  const FolderStatus one = read();
  EXPECT_EQ(one.num_done, 1);
  const std::string first =
      (folder.path() / "s").string() + ": 1 of " + std::to_string(num_all) + " trials finished\n";
  EXPECT_EQ(one.text.substr(0, first.size()), first);
  EXPECT_EQ(one.json.at("finished"), 1);
  EXPECT_EQ(one.damage, "");
  {
    JournalWriter journal(folder.path() / "s", 0);
    for (size_t i = 1; i < plan.size(); ++i) journal.Append(MakeFakeRecord(plan[i]));
  }
  EXPECT_TRUE(read().is_finished);
}

TEST(FolderStatus, SaysWhenNobodyWorksOnAnUnfinishedSession) {
  const TemporaryFolder folder;
  const std::filesystem::path session = folder.path() / "s";
  const std::vector<PlannedTrial> plan = CreateFakeSession(session, 2);
  const auto is_abandoned = [&] {
    return ReadFolderStatus(session, 600.0)
               .text.find("no process of this machine is working on it") != std::string::npos;
  };
  const auto age = [&] {  // past the seconds in which nobody is asked
    const std::filesystem::path journal = session / "journal" / "0.jsonl";
    std::filesystem::last_write_time(
        journal, std::filesystem::file_time_type::clock::now() - std::chrono::minutes(1));
  };
  EXPECT_FALSE(is_abandoned()) << "it has not begun";
  {
    JournalWriter journal(session, 0);
    journal.Append(MakeFakeRecord(plan[0]));
    age();
    EXPECT_FALSE(is_abandoned()) << "somebody writes it";
  }
  age();
  EXPECT_TRUE(is_abandoned());
  {
    JournalWriter journal(session, 0);
    for (size_t i = 1; i < plan.size(); ++i) journal.Append(MakeFakeRecord(plan[i]));
  }
  age();
  EXPECT_FALSE(is_abandoned()) << "it is finished";
}

TEST(FolderStatus, SaysWhatJudgesOnWhenNobodyDoes) {
  const TemporaryFolder folder;
  const std::filesystem::path session = folder.path() / "s";
  const std::vector<PlannedTrial> plan = CreateFakeSession(session, 4);
  {
    JournalWriter journal(session, 0);
    for (const PlannedTrial& planned : plan) journal.Append(MakeFakeRecord(planned));
  }
  const std::vector<PlannedTrial> held =
      FindUnjudged(LoadSession(session, OnDamage::kRefuse, RecordParts::kBrief));
  ASSERT_GE(held.size(), 2u);
  const auto judge = [&](size_t i) {
    JudgementWriter(session, 0).Append(held[i].id, Judgement());
    std::filesystem::last_write_time(
        session / "judge" / "0.jsonl",
        std::filesystem::file_time_type::clock::now() - std::chrono::minutes(1));
  };
  judge(0);
  const std::string count = " of " + std::to_string(held.size()) + " held grasps judged";
  const std::string idle = "; no process of this machine is working on it: graspbench judge ";
  {
    const JudgementWriter writer(session, 0);
    EXPECT_EQ(ReadFolderStatus(session, 600.0).steps.back(), "1" + count) << "somebody judges";
  }
  const FolderStatus one = ReadFolderStatus(session, 600.0);
  EXPECT_EQ(one.steps.back(), "1" + count + idle + session.string() + " goes on with it");
  EXPECT_NE(one.text.find("\n" + one.steps.back() + "\n"), std::string::npos) << one.text;
  for (size_t i = 1; i < held.size(); ++i) judge(i);
  const FolderStatus all = ReadFolderStatus(session, 600.0);
  EXPECT_EQ(all.steps.back(), std::to_string(held.size()) + count);
  EXPECT_TRUE(all.is_finished);
}

TEST(FolderStatus, AnotherFolderIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(ReadFolderStatus(folder.path(), 600.0), Error);
}

TEST(FolderStatus, OfAHandIsThatOfItsDevelopment) {
  const TemporaryFolder folder;
  const std::filesystem::path hand = folder.path() / "mine";
  std::filesystem::create_directories(hand / "development");
  WriteFileAtomically(hand / "hand.yaml", "format: 1\n");
  try {
    ReadFolderStatus(hand, 600.0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), "\"" + hand.string() +
                                "\" is a hand (hand.yaml) without a development; expected the "
                                "folder of a session, campaign, optimisation or development. "
                                "graspbench hand check " +
                                hand.string() + " checks the hand");
  }
  CreateDevelopment(hand / "development", {});
  EXPECT_EQ(
      ReadFolderStatus(hand, 600.0)
          .text.rfind((hand / "development").string() + ": not finished, 0 evaluations kept", 0),
      0u);
}

}  // namespace
}  // namespace graspbench
