#include "datasets/session/judgement_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

Judgement MakeJudgement(double force) {
  Judgement judgement;
  judgement.loads = {{"force +x", force, true}};
  judgement.breaking_force = force;
  judgement.breaking_moment = 0.02;
  judgement.verdicts = {{"graspa", true, 4.0}};
  return judgement;
}

class JudgementStore : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_ = CreateFakeSession(folder(), 4);
    JournalWriter journal(folder(), 0);
    for (const PlannedTrial& planned : plan_) {
      TrialRecord record = MakeFakeRecord(planned);
      record.result.outcome = planned.trial == 0 ? Outcome::kNoContact : Outcome::kSuccess;
      journal.Append(record);
    }
  }
  std::filesystem::path folder() const { return temporary_.path() / "session"; }
  void AppendText(const std::string& text) {
    std::ofstream(folder() / "judge" / "0.jsonl", std::ios::app) << text;
  }

  TemporaryFolder temporary_;
  std::vector<PlannedTrial> plan_;
};

TEST_F(JudgementStore, HeldTrialsAreJudgedOnce) {
  std::vector<PlannedTrial> unjudged = FindUnjudged(LoadSession(folder()));
  ASSERT_EQ(unjudged.size(), plan_.size() * 3 / 4);  // three of four were held
  {
    JudgementWriter writer(folder(), 0);
    writer.Append(unjudged[0].id, MakeJudgement(2.5));
    writer.Append(unjudged[0].id, MakeJudgement(2.5));
  }
  const Session session = LoadSession(folder());
  EXPECT_TRUE(session.findings.entries().empty()) << session.findings.Format();
  unjudged.erase(unjudged.begin());
  EXPECT_EQ(FindUnjudged(session).size(), unjudged.size());
  for (const TrialRecord& record : session.records) {
    if (record.judgement) {
      EXPECT_EQ(RecordToJson(*record.judgement), RecordToJson(MakeJudgement(2.5)));
    }
  }
}

TEST_F(JudgementStore, TwoDifferentJudgementsAreRefused) {
  const std::vector<PlannedTrial> unjudged = FindUnjudged(LoadSession(folder()));
  JudgementWriter(folder(), 0).Append(unjudged[0].id, MakeJudgement(1.0));
  JudgementWriter(folder(), 1).Append(unjudged[0].id, MakeJudgement(2.0));
  EXPECT_TRUE(Throws([&] { LoadSession(folder()); }, ErrorKind::kFormat, "--set-aside FILE"));
}

TEST_F(JudgementStore, ALineOfATrialThatIsNotPlannedIsDamage) {
  JudgementWriter(folder(), 1).Append("0123456789abcdef", MakeJudgement(2.5));
  EXPECT_TRUE(Throws([&] { LoadSession(folder()); }, ErrorKind::kFormat,
                     "judge/1.jsonl:1: trial 0123456789abcdef is not in"));
  EXPECT_EQ(LoadSession(folder(), OnDamage::kAccept).damage.size(), 1u);
}

TEST_F(JudgementStore, DamageCostsTheLineAlone) {
  const std::vector<PlannedTrial> unjudged = FindUnjudged(LoadSession(folder()));
  JudgementWriter(folder(), 0).Append(unjudged[0].id, MakeJudgement(1.0));
  AppendText("{\"trial_id\":\"x\"}\n");
  AppendText("{\"cut");
  EXPECT_THROW(LoadSession(folder()), Error);
  const Session session = LoadSession(folder(), OnDamage::kAccept);
  EXPECT_EQ(FindUnjudged(session).size(), unjudged.size() - 1);
  const std::string text = session.findings.Format();
  EXPECT_NE(text.find("judge/0.jsonl:2"), std::string::npos) << text;
  EXPECT_NE(text.find("the last line is incomplete because the program was stopped; it is ignored"),
            std::string::npos)
      << text;
}

// Its checksum is right, so that no disk has changed it.
TEST_F(JudgementStore, ALineThatIsNoJudgementIsDamage) {
  const std::vector<PlannedTrial> unjudged = FindUnjudged(LoadSession(folder()));
  const JudgementWriter makes_the_file(folder(), 0);
  AppendText(
      FormatCheckedLine(
          {{"trial_id", unjudged[0].id}, {"judge_version", kJudgeVersion}, {"judgement", "much"}}) +
      "\n");
  EXPECT_THROW(LoadSession(folder()), Error);
  const Session session = LoadSession(folder(), OnDamage::kAccept);
  ASSERT_EQ(session.damage.size(), 1u);
  EXPECT_EQ(session.damage[0].path, "judge/0.jsonl");
  EXPECT_EQ(FindUnjudged(session).size(), unjudged.size());
}

}  // namespace
}  // namespace graspbench
