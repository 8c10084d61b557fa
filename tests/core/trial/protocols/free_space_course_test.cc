#include "core/trial/protocols/free_space_course.h"

#include <gtest/gtest.h>

#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** A hand without fingers, far from a block. */
struct Apart {
  FreeSpaceProfile profile;
  ProfiledScene scene;

  Apart() {
    profile.sim.step = 0.002;
    const ScriptedStage stage{"grasp", MakePose(Vector3d(0.0, 0.0, 10.0)), VectorXd()};
    scene = MakeProfiledScene(std::make_shared<const Hand>(MakeBareHand()),
                              std::make_shared<const GraspObject>(MakeBlock(0.1)),
                              MakePose(Vector3d(1.0, 2.0, 3.0)), {stage}, profile);
  }
};

TEST(FreeSpaceCourse, ACopyGoesOnFromTheSameInstant) {
  const Apart apart;
  FreeSpaceCourse course(apart.scene, apart.profile);
  course.Begin();
  course.Push(Vector3d::UnitX());
  course.Wait(0.1);
  FreeSpaceCourse copy = course;
  course.Wait(0.1);
  copy.Wait(0.1);
  EXPECT_EQ(course.CalcMoved().shift, copy.CalcMoved().shift);
  EXPECT_NEAR(copy.CalcMoved().shift, 0.5 * 0.2 * 0.2, 2e-4);
  EXPECT_EQ(copy.num_steps(), 100);
  copy.Push(Vector3d::Zero());
  const double before = copy.CalcMoved().shift;
  copy.Wait(0.1);
  EXPECT_NEAR(copy.CalcMoved().shift, before + 0.2 * 0.1, 1e-9) << "without a load it goes on";
}

TEST(FreeSpaceCourse, MotionIsFromWhereItBegan) {
  const Apart apart;
  FreeSpaceCourse course(apart.scene, apart.profile);
  course.Begin();
  course.Wait(0.01);
  EXPECT_EQ(course.CalcMoved().shift, 0.0);
  EXPECT_EQ(course.CalcMoved().turn_deg, 0.0);
  EXPECT_NEAR(course.CalcMoved(0.1).shift, 0.1, 1e-12) << "it was not raised";
  EXPECT_TRUE(course.ListTouching().empty());
}

TEST(FreeSpaceCourse, TheTraceHasTheStartAndEveryPhase) {
  const Apart apart;
  FreeSpaceCourse plain(apart.scene, apart.profile);
  plain.Begin();
  plain.Wait(0.1);
  EXPECT_TRUE(plain.TakeTrace().empty());
  FreeSpaceCourse course(apart.scene, apart.profile, 0.02);
  course.Begin();
  course.SetPhase(Phase::kClosure);
  course.Wait(0.1);
  course.SetPhase(Phase::kHold);
  course.Wait(0.1);
  const std::vector<TraceInstant> trace = course.TakeTrace();
  ASSERT_EQ(trace.size(), 11u);  // the start, and each 20 ms
  EXPECT_EQ(trace.front().time, 0.0);
  EXPECT_EQ(trace.front().phase, Phase::kPlacing);
  EXPECT_EQ(trace.front().next_phase, Phase::kClosure);
  EXPECT_EQ(trace[1].phase, Phase::kClosure);
  EXPECT_EQ(trace[5].next_phase, Phase::kHold);
  EXPECT_NEAR(trace.back().time, 0.2, 1e-12);
  EXPECT_EQ(ListPhaseEnds(trace).size(), 3u);
  EXPECT_EQ(trace.back().phase, Phase::kHold);
  EXPECT_TRUE(trace.back().X_WO.isApprox(apart.scene.X_WO));
}

}  // namespace
}  // namespace graspbench
