#include "human_study/events/plausibility.h"

#include <gtest/gtest.h>

#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Two tips 60 mm apart that close by 20 mm until 1 s and then move `way` along z until 2 s. */
std::vector<SmoothPath> MakeTips(double way) {
  const std::vector<double> times = MakeTimes(0, 2, 100);
  std::vector<SmoothPath> tips;
  for (const double side : {-1.0, 1.0}) {
    SmoothPath tip;
    tip.path = SamplePath(times, [&](double t) {
      const double open = 0.02 * std::max(0.0, 1.0 - t);
      return Vector3d(side * (0.03 + open / 2), 0, way * std::max(0.0, t - 1.0));
    });
    tips.push_back(tip);
  }
  return tips;
}

TEST(CalcJointTravel, IsTheWayOfDigitsThatKeepTheirDistance) {
  const Hold hold = {2.0, 1.9, 2.0, ""};
  EXPECT_NEAR(CalcJointTravel(MakeTips(0.1), hold), 0.1, 1e-9);
  EXPECT_NEAR(CalcJointTravel(MakeTips(0.0), hold), 0.0, 1e-9);
}

TEST(FindUnseenCarrying, NamesALongWayOnly) {
  const Hold hold = {2.0, 1.9, 2.0, ""};
  const auto doubts = FindUnseenCarrying(MakeTips(0.1), hold, {});
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "carried_unseen");
  EXPECT_TRUE(FindUnseenCarrying(MakeTips(0.03), hold, {}).empty());
}

TEST(FindContactDoubts, EachLimitHasItsCode) {
  DigitContactEvents digit;
  digit.digit = "FF";
  digit.contact.time = 1.5;
  digit.contact.uncertainty = 0.005;
  digit.by_detector.assign(ContactDetectorList().size(), digit.contact);
  Movement movement;
  movement.end.time = 1.4;
  ObjectEvents object;
  object.moved = object.lift_off = MissingEvent("none");
  const auto code = [&](double gct) {
    const auto doubts = FindContactDoubts({digit}, movement, object, gct, {});
    return doubts.empty() ? "" : doubts.front().code;
  };
  EXPECT_EQ(code(0.5), "");
  EXPECT_EQ(code(1.6), "closure_too_long");
  movement.end.time = 1.1;
  EXPECT_EQ(code(0.5), "contact_after_end");
  movement.end.time = 1.4;
  digit.by_detector[FindContactDetector("speed")].time = 1.3;
  EXPECT_EQ(code(0.5), "");
  digit.by_detector[FindContactDetector("surface")].time = 1.3;
  EXPECT_EQ(code(0.5), "detectors_disagree");
  digit.by_detector.assign(ContactDetectorList().size(), digit.contact);
  object.moved = digit.contact;
  object.moved.time = 1.4;
  EXPECT_EQ(code(0.5), "moved_before_touch");
}

}  // namespace
}  // namespace graspbench
