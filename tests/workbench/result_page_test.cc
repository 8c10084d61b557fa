#include "workbench/result_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/records/trial_record.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {

namespace {

namespace fs = std::filesystem;

class ResultPageTest : public testing::Test {
 protected:
  ResultPageTest()
      : top_(fs::path(testing::TempDir()) / ("result_page_" + std::to_string(::getpid()))) {
    fs::remove_all(top_);
    fs::create_directories(top_);
  }
  ~ResultPageTest() override { fs::remove_all(top_); }

  std::string FindFault(const fs::path& folder) const {
    try {
      WriteResultPage(folder, folder, OnDamage::kRefuse);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "none";
  }

  fs::path top_;
};

TEST_F(ResultPageTest, APageThatWasWrittenWithItsResultIsFoundAndCanBeCopied) {
  StagedFolder staged({top_ / "b", "basin", false, {}});
  MakeFolder(staged.path() / "report");
  WriteFile(staged.path() / "report" / "index.html", "the page");
  staged.Commit();
  EXPECT_EQ(WriteResultPage(top_ / "b", top_ / "b", OnDamage::kRefuse), "report/index.html");
  EXPECT_EQ(WriteResultPage(top_ / "b", top_ / "c", OnDamage::kRefuse), "report/index.html");
  EXPECT_EQ(ReadFile(top_ / "c" / "report" / "index.html"), "the page");
}

TEST_F(ResultPageTest, AChangedPageIsRefused) {
  StagedFolder staged({top_ / "b", "study", false, {}});
  WriteFile(staged.path() / "index.html", "the page");
  staged.Commit();
  WriteFile(top_ / "b" / "index.html", "another");
  EXPECT_NE(FindFault(top_ / "b").find("index.html"), std::string::npos) << FindFault(top_ / "b");
}

TEST_F(ResultPageTest, AFolderWithoutAResultIsRefusedAndAdviceDoesNotWriteIntoIt) {
  fs::create_directories(top_ / "mine");
  WriteFile(top_ / "mine" / "letter.txt", "dear");
  const std::string fault = FindFault(top_ / "mine");
  EXPECT_NE(fault.find("holds no result of graspbench; expected the folder of a session"),
            std::string::npos)
      << fault;
  EXPECT_EQ(fault.find("--out"), std::string::npos) << fault;
  EXPECT_NE(FindFault(top_ / "nowhere").find("is not there"), std::string::npos);
  WriteFile(top_ / "mine" / "scene.json", "{}");
  EXPECT_NE(FindFault(top_ / "mine").find("optimisation, which has no page"), std::string::npos);
}

TEST(TraceSession, EveryTrialIsThatOfTheSession) {
  Session session;
  session.config.hands = {"tum"};
  session.config.objects = {"golf_ball"};
  session.config.trials = 2;
  const SessionInputs inputs = LoadSessionInputs(session.config);
  session.plan = MakePlan(session.config, inputs);
  const TrialTracer trace = MakeTrialTracer(session);
  // Backwards: what was carried out before leaves nothing behind.
  for (auto planned = session.plan.rbegin(); planned != session.plan.rend(); ++planned) {
    const TrialSetup setup = MakeTrialSetup(session.config, inputs, *planned);
    const TrialResult result = TrialRunner(setup.hand, setup.object).Run(setup);
    const TracedTrial traced = trace(*planned);
    EXPECT_FALSE(FindFirstDifference(result, traced.result)) << planned->id;
    EXPECT_GT(traced.trace.size(), 100u);
  }
}

}  // namespace

}  // namespace graspbench
