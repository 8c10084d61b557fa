// A trial in steps: the result does not depend on who steps it, where it was saved, or how often it
// was restored. The oracle is always the same trial, run in one go.

#include "core/trial/protocols/table_lift.h"

#include <gtest/gtest.h>

#include "core/physics/implicit_world.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TableLift MakeCourse(const TrialSetup& setup) {
  return {std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup};
}

std::string Finish(TableLift& course) {
  while (course.Advance()) {
  }
  return ToJson(course.End()).dump();
}

class TableLiftTest : public testing::TestWithParam<const char*> {
 protected:
  TrialSetup MakeHeld() const { return MakeSetup(GetParam(), "g2", MakeCube(0.0122, 0.5)); }
  /** Too slippery to be lifted: it ends before the hold. */
  TrialSetup MakeLost() const { return MakeSetup(GetParam(), "g2", MakeCube(0.0122, 0.02)); }
};

void ExpectEqualFromEveryInstant(const TrialSetup& setup, int interval) {
  TableLift course = MakeCourse(setup);
  const std::string expected = ToJson(MakeCourse(setup).Run()).dump();
  std::vector<TrialInstant> instants;
  course.Begin();
  for (int step = 0;; ++step) {
    if (step % interval == 0) instants.push_back(course.Save());
    if (!course.Advance()) break;
  }
  instants.push_back(course.Save());
  EXPECT_EQ(ToJson(course.End()).dump(), expected) << "saving disturbs";
  ASSERT_GT(instants.size(), 10u);
  TableLift other = MakeCourse(setup);  // has not begun
  for (auto instant = instants.rbegin(); instant != instants.rend(); ++instant) {
    other.Restore(*instant);
    EXPECT_EQ(other.time(), instant->notes.time);
    EXPECT_EQ(Finish(other), expected) << "from " << instant->notes.time << " s";
  }
}

TEST_P(TableLiftTest, GoesOnToTheSameBytesFromEverySavedInstant) {
  // No divisor of any of the meters' intervals, so that all parts of a cycle are met.
  ExpectEqualFromEveryInstant(MakeHeld(), 67);
  ExpectEqualFromEveryInstant(MakeLost(), 67);
}

TEST_P(TableLiftTest, ABranchTakesItsOwnWay) {
  const TrialSetup setup = MakeHeld();
  TableLift course = MakeCourse(setup);
  course.Begin();
  while (course.time() < 2.0 && course.Advance()) {
  }
  const TrialInstant instant = course.Save();
  const std::string expected = Finish(course);
  course.Restore(instant);
  course.world().SetGravity(Eigen::Vector3d(0.0, 0.0, -30.0));
  EXPECT_NE(Finish(course), expected) << "the change reaches the branch";
  course.Restore(instant);
  EXPECT_EQ(Finish(course), expected) << "and the branch only";
}

TEST_P(TableLiftTest, IsOverOnceAndForAll) {
  const TrialSetup setup = MakeHeld();
  TableLift course = MakeCourse(setup);
  EXPECT_FALSE(course.is_held());
  course.Begin();
  int num_steps = 0, num_long = 0;
  double time = 0.0;
  while (course.Advance()) {
    ++num_steps;
    const bool is_long = course.last_command().num_steps > 1;
    num_long += is_long ? 1 : 0;
    ASSERT_TRUE(!is_long || course.phase() >= Phase::kLiftOff);
    time += course.last_command().num_steps * setup.sim.step;
    ASSERT_NEAR(course.time(), time, 1e-9);
    ASSERT_FALSE(course.is_held());
  }
  EXPECT_GT(num_long, 100);
  EXPECT_TRUE(course.is_held());
  const std::string first = ToJson(course.End()).dump();
  const Eigen::VectorXd q = course.world().state().q;
  EXPECT_FALSE(course.Advance());
  EXPECT_EQ(course.world().state().q, q);
  EXPECT_EQ(ToJson(course.End()).dump(), first) << "asking twice changes nothing";
  EXPECT_EQ(course.End().num_steps, num_steps);
  EXPECT_EQ(ToJson(TrialRunner(setup.hand, setup.object).Run(setup)).dump(), first);
}

TEST_P(TableLiftTest, LongStepsWhereNothingHappensGiveTheSameTrial) {
  TrialSetup setup = MakeHeld();
  const TrialResult with = MakeCourse(setup).Run();
  setup.sim.steady_step_factor = 1;
  const TrialResult without = MakeCourse(setup).Run();
  EXPECT_LT(with.num_steps, 0.7 * without.num_steps);
  EXPECT_EQ(with.outcome, without.outcome);
  EXPECT_EQ(with.grip_force, without.grip_force) << "until lift-off nothing differs";
  EXPECT_EQ(with.stability.hold.num_samples, without.stability.hold.num_samples);
  EXPECT_EQ(with.stability.lift.num_samples, without.stability.lift.num_samples);
  EXPECT_NEAR(with.stability.sigma, without.stability.sigma, 0.01 * without.stability.sigma);
  EXPECT_NEAR(with.simulated_time, without.simulated_time, 1e-9);
  EXPECT_LT(std::abs(with.energy_residual), 1e-4);
}

/** The hand comes along two axes, and closes on its way. */
TrialSetup PlayCourse(TrialSetup setup) {
  GraspCourse& course = setup.grasp.course;
  course.period = 0.02;
  course.closure_start = 0.2;
  for (int k = 0; k <= 25; ++k) {
    const double left = 0.02 * (25 - k);
    course.p_HAway.emplace_back(0.05 * left * left, 0.0, -0.3 * left * left);
    for (const std::string& digit : setup.grasp.digits) {
      course.closing[digit].push_back(0.2 * std::max(0.0, 0.02 * k - 0.2));
    }
  }
  return setup;
}

// The reach is the strategy's: hand and digits are asked for what the course has at that time.
TEST_P(TableLiftTest, FollowsTheCourseOfAReach) {
  const TrialSetup setup = PlayCourse(MakeHeld());
  const GraspCourse& course = setup.grasp.course;
  const Pose X_WH = CalcPlacement(*setup.hand, setup.grasp, *setup.object).X_WH;
  TableLift trial = MakeCourse(setup);
  trial.Begin();
  EXPECT_LT((trial.world().state().X_WH.translation() - X_WH * course.p_HAway.front()).norm(),
            1e-12);
  const std::string& digit = setup.grasp.digits.front();
  const int joint =
      FindDrivenJoints(*setup.hand, setup.hand->digits[static_cast<size_t>(
                                        ListGraspingDigits(*setup.hand, setup.grasp).front())])
          .front();
  const double way = setup.grasp.q_target[joint] - setup.grasp.q_pre[joint];
  while (trial.time() < course.duration() - setup.sim.step && trial.Advance()) {
    const WorldCommand& command = trial.last_command();
    const Eigen::Vector3d away = X_WH * CalcHandAway(course, trial.time());
    EXPECT_LT((command.X_WH.translation() - away).norm(), 1e-9) << trial.time();
    const double s = CalcCourseClosing(course.closing.at(digit), course.period, trial.time());
    EXPECT_NEAR(command.q[joint] - setup.draw.joint_error[joint],
                setup.grasp.q_pre[joint] + s * way, 1e-9);
    if (std::abs(trial.time() - course.closure_start) < 2.0 * setup.sim.step) continue;
    EXPECT_EQ(trial.phase(),
              trial.time() < course.closure_start ? Phase::kPlacing : Phase::kClosure);
  }
  EXPECT_NEAR(trial.closure_start(), course.closure_start, 2.0 * setup.sim.step);
  ExpectEqualFromEveryInstant(setup, 67);
}

INSTANTIATE_TEST_SUITE_P(Hands, TableLiftTest, testing::Values("tum", "shadow"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace graspbench
