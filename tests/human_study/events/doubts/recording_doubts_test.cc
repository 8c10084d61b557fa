#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/base/random.h"
#include "human_study/events/doubts/plausibility.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

constexpr size_t kNumSamples = 200;  // at 100 Hz; the hold is at 1 s

/** Digits at rest about an object; from 1.2 s on all rise by `rise`. */
std::vector<SmoothPath> MakeRisingTips(const std::vector<Eigen::Vector3d>& places, double rise) {
  std::vector<SmoothPath> tips(places.size());
  for (size_t d = 0; d < tips.size(); ++d) {
    tips[d].path = SamplePath(MakeTimes(0.0, 1.99, 100.0), [&](double t) {
      return Eigen::Vector3d(places[d] + Eigen::Vector3d(0.0, 0.0, t > 1.2 ? rise : 0.0));
    });
  }
  return tips;
}

ObjectTravel MakeStill(double moved) {
  ObjectTravel travel;
  travel.displacement.values = Eigen::VectorXd::Constant(kNumSamples, moved);
  return travel;
}

Hold MakeHoldAt(double time) {
  Hold hold;
  hold.time = hold.begin = hold.end = time;
  return hold;
}

const std::vector<Eigen::Vector3d> kOpposed = {{0.0, -0.04, 0.0},
                                               {-0.03, 0.04, 0.0},
                                               {-0.01, 0.04, 0.0},
                                               {0.01, 0.04, 0.0},
                                               {0.03, 0.04, 0.0}};

std::vector<DigitTrack> MakeDigits() {
  std::vector<DigitTrack> digits(5);
  const std::array<const char*, 5> names = {"TH", "FF", "MF", "RF", "LF"};
  for (size_t d = 0; d < 5; ++d) digits[d].digit = names[d];
  digits[0].is_thumb = true;
  return digits;
}

TEST(FindLeftBehind, AHandThatRisesWithoutItsObject) {
  const auto find = [](double rise, double moved) {
    return FindLeftBehind(MakeRisingTips(kOpposed, rise), MakeStill(moved), MakeHoldAt(1.0), {},
                          {});
  };
  ASSERT_EQ(find(0.13, 0.0).size(), 1u);
  EXPECT_EQ(find(0.13, 0.0)[0].code, "object_left_behind");
  ExpectHolds(find(0.13, 0.0)[0].text, "rise 130 mm together");
  ExpectHolds(find(0.035, 0.0)[0].text, "rise 35 mm together");
  EXPECT_TRUE(find(0.02, 0.0).empty());   // no lift
  EXPECT_TRUE(find(0.13, 0.05).empty());  // the object goes along
}

// The longest rest is often that aloft, and a hand that is never seen at rest has none.
TEST(FindLeftBehind, AlsoWhereTheHoldIsAloftOrNotFound) {
  const auto find = [](const Hold& hold, const std::vector<SmoothPath>& tips) {
    return FindLeftBehind(tips, MakeStill(0.0), hold, {}, {}).size();
  };
  Hold none;
  none.missing = "the tips never rest together";
  for (const Hold& hold : {MakeHoldAt(1.9), none}) {
    EXPECT_EQ(find(hold, MakeRisingTips(kOpposed, 0.13)), 1u);
    std::vector<SmoothPath> loose = MakeRisingTips(kOpposed, 0.13);
    for (Eigen::Index i = 0; i < 150; ++i) loose[4].path.p(0, i) += 0.02;
    EXPECT_EQ(find(hold, loose), 1u);  // one digit takes no part
    // A hand that opens and goes up has let go.
    for (size_t d = 1; d < 4; ++d) {
      for (Eigen::Index i = 0; i < 130; ++i) loose[d].path.p(1, i) += 0.02;
    }
    EXPECT_EQ(find(hold, loose), 0u);
  }
}

TEST(FindSwappedThumb, TheOpposingDigitIsTheThumb) {
  const std::vector<DigitTrack> digits = MakeDigits();
  EXPECT_TRUE(FindSwappedThumb(digits, MakeRisingTips(kOpposed, 0.0), MakeHoldAt(1.0)).empty());
  std::vector<Eigen::Vector3d> exchanged = kOpposed;
  std::swap(exchanged[0], exchanged[1]);
  const auto doubts = FindSwappedThumb(digits, MakeRisingTips(exchanged, 0.0), MakeHoldAt(1.0));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "thumb_not_opposed");
  ExpectHolds(doubts[0].text, "digit FF is opposite all others");
  // All in one row, as on a flat hand: nothing to say.
  const std::vector<Eigen::Vector3d> row = {
      {-0.06, 0.0, 0.0}, {-0.03, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.03, 0.0, 0.0}, {0.06, 0.0, 0.0}};
  EXPECT_TRUE(FindSwappedThumb(digits, MakeRisingTips(row, 0.0), MakeHoldAt(1.0)).empty());
}

/** Places of a right hand from the wrist's marker, palm down, the thumb on the left: lengths of
adult hands, each joint's share by chance. */
std::vector<Eigen::Vector3d> PlaceHand(bool is_curled, RandomStream& random) {
  const auto near = [&](double x, double y, double z) -> Eigen::Vector3d {
    return Eigen::Vector3d(x, y, z) +
           6e-3 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal());
  };
  std::vector<Eigen::Vector3d> places = {near(0.105, 0.045, -0.03), near(0.14, -0.005, -0.03)};
  const double out = is_curled ? 0.075 : 0.138, down = is_curled ? -0.025 : -0.035;
  for (int d = 0; d < 3; ++d) places.push_back(near(out - 0.008 * d, -0.02 - 0.018 * d, down));
  return places;
}

int CountExchanged(bool is_curled, bool is_exchanged) {
  int count = 0;
  for (int i = 0; i < 20; ++i) {
    RandomStream random("hand " + std::to_string(i), is_curled ? "curled" : "all five");
    std::vector<Eigen::Vector3d> places = PlaceHand(is_curled, random);
    if (is_exchanged) std::swap(places[0], places[1]);
    const std::vector<SmoothPath> tips = MakeRisingTips(places, 0.1);
    Trajectory wrist = tips[0].path;
    for (Eigen::Index c = 0; c < wrist.p.cols(); ++c) wrist.p.col(c) -= places[0];
    count += MayBeExchanged(MakeDigits(), tips, wrist, 0.2, MakeHoldAt(1.0));
    EXPECT_FALSE(MayBeExchanged(MakeDigits(), tips, {}, 0.2, MakeHoldAt(1.0))) << "no wrist";
  }
  return count;
}

TEST(MayBeExchanged, AsAnatomyShowsItAndNotForAPinchWithCurledFingers) {
  EXPECT_GE(CountExchanged(false, true), 18);
  EXPECT_LE(CountExchanged(false, false), 1);
  EXPECT_LE(CountExchanged(true, false), 1);
}

// Lifted by 60 mm along z and then carried by 100 mm along x: with x as the stated direction it
// goes elsewhere first; with z, or pushed by 15 mm before a lift of 130 mm, it does not.
TEST(GoesElsewhereFirst, AWrongAxisAndNoPush) {
  const auto goes = [](const Eigen::Vector3d& up, double push, double height, double aside) {
    ReachTrial trial;
    for (int i = 0; i < 300; ++i) {
      const double t = 0.01 * i;
      trial.times.push_back(t);
      Pose pose = Pose::Identity();
      pose.translation() = Eigen::Vector3d(push * Ease(t, 0.4, 0.5) + aside * Ease(t, 1.2, 2.0),
                                           0.0, height * Ease(t, 1.0, 1.8));
      trial.object.X_LO.push_back(pose);
      trial.object.states.push_back(SampleState::kMeasured);
    }
    LiftOffOptions options;
    options.up_x = up.x();
    options.up_y = up.y();
    options.up_z = up.z();
    const ObjectTravel travel = CalcObjectTravel(trial, options);
    return GoesElsewhereFirst(travel, FindObjectEvents(travel, options).lift_off, options);
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(goes(x, 0.0, 0.06, 0.1));
  EXPECT_FALSE(goes(z, 0.0, 0.06, 0.1));
  EXPECT_FALSE(goes(z, 0.015, 0.13, 0.0));
  EXPECT_FALSE(goes(z, 0.0, 0.13, 0.0));
}

}  // namespace
}  // namespace graspbench
