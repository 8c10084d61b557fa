#include <gtest/gtest.h>

#include "core/physics/known_answers/small_scenes.h"
#include "reports/kind_pages.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TEST(GraspPage, SaysTheVerdictItsProfileAndWhatWasAssumed) {
  GraspPageData data;
  data.name = "a <b>.npy, grasp 0";
  data.hand = std::make_shared<const Hand>(MakeBareHand());
  data.object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  data.profile.name = "mine";
  data.profile.sim.step = 0.002;
  data.assumptions = {"the wrist is straight"};
  const ScriptedStage stage{"grasp", MakePose(Eigen::Vector3d(0.0, 0.0, 0.2)), Eigen::VectorXd()};
  data.traced = TraceFreeSpace(
      MakeProfiledScene(data.hand, data.object, Pose::Identity(), {stage}, data.profile),
      data.profile, 0.01);
  ASSERT_FALSE(data.traced.trace.empty());
  const std::string page = MakeGraspPage(data);
  ExpectParts(page, {"Under mine the grasp fails at: grasp. The hand does not reach",
                     "the wrist is straight", "a &lt;b&gt;.npy"});
  EXPECT_NE(page.find("data-motion"), std::string::npos) << "the 3-D view";
}

TEST(GraspPage, AGraspThatCouldNotBeginHasNoCourse) {
  GraspPageData data;
  data.hand = std::make_shared<const Hand>(MakeBareHand());
  data.object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  data.traced.result.failed_stage = "start";
  data.traced.result.reason = "at pregrasp the hand is 12.0 mm deep in the object";
  const std::string page = MakeGraspPage(data);
  ExpectParts(page, {"there is no motion to show", "12.0 mm deep"});
}

}  // namespace
}  // namespace graspbench
