#include "core/grasp/grasp_course.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grasp/closing_law.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A parabola that ends with slope zero: the cubic reproduces it between inner instants. */
GraspCourse MakeParabola() {
  GraspCourse course;
  course.period = 0.05;
  for (int k = 0; k <= 10; ++k) {
    const double left = 0.5 - 0.05 * k;
    course.p_HAway.emplace_back(0.0, 0.4 * left * left, -0.2 * left * left);
    course.closing["FF"].push_back(0.08 * k);
  }
  return course;
}

TEST(GraspCourse, PassesThroughItsInstantsAndBetweenThem) {
  const GraspCourse course = MakeParabola();
  EXPECT_NEAR(course.duration(), 0.5, 1e-12);
  for (const double time : {0.06, 0.1, 0.237, 0.4, 0.449}) {
    const double left = 0.5 - time;
    const Vector3d away(0.0, 0.4 * left * left, -0.2 * left * left);
    EXPECT_LT((CalcHandAway(course, time) - away).norm(), 1e-12) << time;
    const Vector3d speed(0.0, -0.8 * left, 0.4 * left);
    EXPECT_LT((CalcHandSpeed(course, time) - speed).norm(), 1e-12) << time;
  }
}

TEST(GraspCourse, StandsBeforeAndAfter) {
  const GraspCourse course = MakeParabola();
  EXPECT_EQ(CalcHandAway(course, -1.0), course.p_HAway.front());
  EXPECT_EQ(CalcHandAway(course, 0.7), Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(CalcHandSpeed(course, -1.0), Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(CalcHandSpeed(course, 0.7), Vector3d(0.0, 0.0, 0.0));
  EXPECT_LT(CalcHandSpeed(course, 0.499999).norm(), 1e-5);  // it arrives without a jump
  EXPECT_GT(CalcHandSpeed(course, 0.0).norm(), 0.1);        // and begins on its way
  EXPECT_EQ(CalcCourseClosing({}, 0.05, 0.3), 0.0);
  EXPECT_EQ(CalcCourseClosing({0.0, 1.0, 1.0, 0.2}, 1.0, 1.5), 1.0);  // clipped
}

// First the course, then the line of the law at its own speed; a delay shifts the course.
TEST(GraspCourse, ADigitGoesOnAfterIt) {
  constexpr double kStep = 0.002, kTime = 0.8;
  const std::vector<double> closing = MakeParabola().closing.at("FF");
  for (const double delay : {0.0, 0.1}) {
    ClosingLaw law({delay, 0.5}, closing, 0.05);
    double time = 0.0;
    for (; time < 0.5 + delay - 1e-9; time += kStep) {
      EXPECT_NEAR(law.closing(), CalcCourseClosing(closing, 0.05, time - delay), 1e-9) << time;
      law.Advance(kStep, kTime, 1.0);
    }
    EXPECT_NEAR(law.closing(), 0.8, 1e-9);
    for (int i = 0; i < 50; ++i) law.Advance(kStep, kTime, 1.0);
    EXPECT_NEAR(law.closing(), 0.8 + 0.1 * 0.5 / kTime, 1e-9);
  }
}

}  // namespace
}  // namespace graspbench
