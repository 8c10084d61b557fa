#include "human_study/events/doubts/recording_doubts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace graspbench {
namespace {

constexpr size_t kNumSamples = 200;  // at 100 Hz; the hold is at 1 s

/** Digits at rest about an object; from 1.2 s on all rise by `rise`. */
std::vector<SmoothPath> MakeTips(const std::vector<Eigen::Vector3d>& places, double rise) {
  std::vector<SmoothPath> tips(places.size());
  for (size_t d = 0; d < tips.size(); ++d) {
    Trajectory& path = tips[d].path;
    path.p.resize(3, kNumSamples);
    for (size_t i = 0; i < kNumSamples; ++i) {
      const double t = 0.01 * static_cast<double>(i);
      path.times.push_back(t);
      path.states.push_back(SampleState::kMeasured);
      path.p.col(static_cast<Eigen::Index>(i)) =
          places[d] + Eigen::Vector3d(0.0, 0.0, t > 1.2 ? rise : 0.0);
    }
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

std::vector<DigitTrack> MakeDigits(size_t count = 5) {
  std::vector<DigitTrack> digits(count);
  const std::array<const char*, 5> names = {"TH", "FF", "MF", "RF", "LF"};
  for (size_t d = 0; d < count; ++d) digits[d].digit = names[d];
  digits[0].is_thumb = true;
  return digits;
}

TEST(FindLeftBehind, AHandThatRisesWithoutItsObject) {
  const auto find = [](double rise, double moved) {
    return FindLeftBehind(MakeTips(kOpposed, rise), MakeStill(moved), MakeHoldAt(1.0), {}, {});
  };
  ASSERT_EQ(find(0.13, 0.0).size(), 1u);
  EXPECT_EQ(find(0.13, 0.0)[0].code, "object_left_behind");
  EXPECT_NE(find(0.13, 0.0)[0].text.find("rise 130 mm together"), std::string::npos);
  EXPECT_NE(find(0.035, 0.0)[0].text.find("rise 35 mm together"), std::string::npos);
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
    EXPECT_EQ(find(hold, MakeTips(kOpposed, 0.13)), 1u);
    std::vector<SmoothPath> loose = MakeTips(kOpposed, 0.13);
    for (Eigen::Index i = 0; i < 150; ++i) loose[4].path.p(0, i) += 0.02;
    EXPECT_EQ(find(hold, loose), 1u);  // one digit takes no part
    // A hand that opens and goes up has let go.
    for (size_t d = 1; d < 4; ++d) {
      for (Eigen::Index i = 0; i < 130; ++i) loose[d].path.p(1, i) += 0.02;
    }
    EXPECT_EQ(find(hold, loose), 0u);
  }
}

/** From `open` at 0.5 s to `closed` at 1 s. */
std::vector<SmoothPath> MakeClosing(const std::vector<Eigen::Vector3d>& open,
                                    const std::vector<Eigen::Vector3d>& closed) {
  std::vector<SmoothPath> tips = MakeTips(open, 0.0);
  for (size_t d = 0; d < tips.size(); ++d) {
    for (size_t i = 0; i < kNumSamples; ++i) {
      const double share = std::clamp((tips[d].path.times[i] - 0.5) / 0.5, 0.0, 1.0);
      tips[d].path.p.col(static_cast<Eigen::Index>(i)) += share * (closed[d] - open[d]);
    }
  }
  return tips;
}

TEST(FindSwappedThumb, TheOpenHandTellsWhereTheThingIsSmall) {
  // About a stick of 20 mm the row of the fingers is longer than the way across.
  std::vector<Eigen::Vector3d> open, closed;
  for (int d = 0; d < 5; ++d) {
    const double side = d == 0 ? -1.0 : 1.0, along = d == 0 ? 0.03 : 0.02 * (d - 1);
    open.emplace_back(along, 0.045 * side, 0.0);
    closed.emplace_back(along, 0.012 * side, 0.0);
  }
  const auto count = [&](size_t num_digits) {
    const auto some = [&](const std::vector<Eigen::Vector3d>& all) {
      return std::vector<Eigen::Vector3d>(all.begin(),
                                          all.begin() + static_cast<std::ptrdiff_t>(num_digits));
    };
    return FindSwappedThumb(MakeDigits(num_digits), MakeClosing(some(open), some(closed)),
                            MakeHoldAt(1.0))
        .size();
  };
  for (const size_t num_digits : {3u, 4u, 5u}) EXPECT_EQ(count(num_digits), 0u) << num_digits;
  EXPECT_EQ(count(2), 0u);
  std::swap(open[0], open[1]);
  std::swap(closed[0], closed[1]);
  for (const size_t num_digits : {3u, 4u, 5u}) EXPECT_EQ(count(num_digits), 1u) << num_digits;
  EXPECT_EQ(count(2), 0u) << "nothing tells two digits apart";
}

// A pinch with the other fingers stretched away: they are far from the thing, but nothing closes
// against them.
TEST(FindSwappedThumb, AFingerHeldAsideIsNoThumb) {
  const std::vector<Eigen::Vector3d> open = {
      {0.0, -0.04, 0.0}, {0.0, 0.04, 0.0}, {0.02, 0.06, 0.0}, {0.04, 0.08, 0.0}, {0.06, 0.1, 0.0}};
  std::vector<Eigen::Vector3d> closed = open;
  closed[0] = {0.0, -0.008, 0.0};
  closed[1] = {0.0, 0.008, 0.0};
  EXPECT_TRUE(FindSwappedThumb(MakeDigits(), MakeClosing(open, closed), MakeHoldAt(1.0)).empty());
}

TEST(FindSwappedThumb, TheOpposingDigitIsTheThumb) {
  const std::vector<DigitTrack> digits = MakeDigits();
  EXPECT_TRUE(FindSwappedThumb(digits, MakeTips(kOpposed, 0.0), MakeHoldAt(1.0)).empty());
  std::vector<Eigen::Vector3d> exchanged = kOpposed;
  std::swap(exchanged[0], exchanged[1]);
  const auto doubts = FindSwappedThumb(digits, MakeTips(exchanged, 0.0), MakeHoldAt(1.0));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "thumb_not_opposed");
  EXPECT_NE(doubts[0].text.find("digit FF is opposite all others"), std::string::npos);
  // All in one row, as on a flat hand: nothing to say.
  const std::vector<Eigen::Vector3d> row = {
      {-0.06, 0.0, 0.0}, {-0.03, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.03, 0.0, 0.0}, {0.06, 0.0, 0.0}};
  EXPECT_TRUE(FindSwappedThumb(digits, MakeTips(row, 0.0), MakeHoldAt(1.0)).empty());
}

}  // namespace
}  // namespace graspbench
