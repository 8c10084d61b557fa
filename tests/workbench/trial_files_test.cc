#include "workbench/trial_files.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "datasets/journal/sealed_store.h"
#include "objects/catalogue.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

class TrajectoryOutputTest : public testing::Test {
 protected:
  TrajectoryOutputTest() {
    setup_.hand = std::make_shared<Hand>(LoadHand("tum"));
    setup_.object = LoadObject("golf_ball", FieldUse::kLater);
    TraceInstant instant;
    instant.q = instant.q_asked = Eigen::VectorXd::Zero(setup_.hand->num_joints());
    traced_.trace = {instant};
    traced_.closure_start = 0.0;
  }

  PlannedTrial Plan(int trial) const {
    return {"000000000000000" + std::to_string(trial), "tum", "golf_ball", "g1", trial};
  }
  std::string FindUsageError(const std::string& name, const std::string& out, size_t num_trials) {
    try {
      TrajectoryOutput({name, out, false, 60.0, ""}, num_trials);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      return error.what();
    }
    return "";
  }
  std::string Collect(const std::string& folder, const std::vector<int>& order) {
    TrajectoryOutput output({"h5", place_ / folder, false, 60.0, ""}, 3);
    for (const int trial : order) {
      output.Take(static_cast<size_t>(trial), Plan(trial), setup_,
                  trial == 1 ? TracedTrial() : traced_);
    }
    EXPECT_EQ(output.num_skipped(), 1);
    output.Commit();
    return ReadFile(place_ / folder / "trajectories.h5");
  }

  TemporaryFolder temporary_;
  std::filesystem::path place_ = temporary_.path();
  TrialSetup setup_;
  TracedTrial traced_;
};

TEST_F(TrajectoryOutputTest, WritesAFileATrialIntoASealedFolder) {
  TrajectoryOutput output({"csv", place_ / "t", false, 60.0, ""}, 2);
  for (int trial : {1, 0}) output.Take(static_cast<size_t>(trial), Plan(trial), setup_, traced_);
  EXPECT_FALSE(std::filesystem::exists(place_ / "t")) << "before all is there";
  EXPECT_EQ(output.Commit(), std::vector<std::filesystem::path>{place_ / "t"});
  EXPECT_FALSE(ReadFile(place_ / "t" / "tum-golf_ball-g1-1.contacts.csv").empty());
  const StoreState state = CheckStore(place_ / "t");
  EXPECT_EQ(state.kind, "trajectories");
  EXPECT_TRUE(state.damages.empty());
}

TEST_F(TrajectoryOutputTest, CollectsInTheOrderOfThePlan) {
  const std::string bytes = Collect("a", {0, 1, 2});
  EXPECT_TRUE(bytes == Collect("b", {2, 1, 0}));
  EXPECT_TRUE(bytes == Collect("c", {1, 2, 0}));
}

TEST_F(TrajectoryOutputTest, WritesOneTrialUnderTheNameThatWasGiven) {
  TrajectoryOutput output({(place_ / "x.csv").string(), "", false, 60.0, ""}, 1);
  output.Take(0, Plan(0), setup_, traced_);
  EXPECT_EQ(output.Commit().size(), 5u);  // with the places of tactile elements and their forces
  EXPECT_FALSE(ReadFile(place_ / "x.events.csv").empty());
  EXPECT_NE(FindUsageError((place_ / "x.csv").string(), "", 1).find("already there"),
            std::string::npos);
}

TEST_F(TrajectoryOutputTest, SaysWhatIsMissing) {
  EXPECT_NE(FindUsageError("mcap", "", 1).find("add --out DIR"), std::string::npos);
  EXPECT_NE(FindUsageError("x.mcap", "t", 1).find("give the format only: mcap"), std::string::npos);
  EXPECT_NE(FindUsageError("x.mcap", "", 2).find("there are 2 trials"), std::string::npos);
  EXPECT_EQ(FindUsageError((place_ / "x.h5").string(), "", 2), "");
  EXPECT_NE(FindUsageError("x.bag", "", 1).find("has none of the known endings"),
            std::string::npos);
}

}  // namespace

}  // namespace graspbench
