#include "datasets/session/session_experiments.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

class SessionExperiments : public testing::Test {
 protected:
  SessionExperiments() {
    CreateFakeSession(folder_.path(), 2);
    session_ = LoadSession(folder_.path());
  }

  /** Below the session, with the configuration given. */
  void Create(const std::string& name, const SessionConfig& config,
              const std::vector<PlannedTrial>& plan) {
    CreateSession(folder_.path() / name, config, plan);
  }
  std::string FindComplaint() {
    try {
      LoadExperiments(session_, "sensitivity");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kFormat);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  Session session_;
};

TEST_F(SessionExperiments, MayHaveFewerTrialsAndConditions) {
  SessionConfig config = session_.config;
  config.trials = 1;
  config.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  PlannedTrial varied = session_.plan.front();
  varied.id = "another";
  varied.condition = "heavy";
  Create("sensitivity/1", config, {session_.plan.front(), varied});
  const std::vector<Session> found = LoadExperiments(session_, "sensitivity");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].plan.size(), 2u);
  EXPECT_TRUE(LoadExperiments(session_, "numerics").empty());
}

TEST_F(SessionExperiments, OfAnotherSeedAreRefused) {
  SessionConfig config = session_.config;
  config.seed = 7;
  Create("sensitivity/2", config, {session_.plan.front()});
  const std::string complaint = FindComplaint();
  EXPECT_NE(complaint.find("\"sensitivity/2\" is an experiment on another session"), complaint.npos)
      << complaint;
  EXPECT_NE(complaint.find("seed: 1 and 7"), complaint.npos) << complaint;
}

TEST_F(SessionExperiments, OfASessionInMemoryAreNone) {
  Session session = session_;
  session.folder.clear();
  EXPECT_TRUE(LoadExperiments(session, "sensitivity").empty());
}

}  // namespace
}  // namespace graspbench
