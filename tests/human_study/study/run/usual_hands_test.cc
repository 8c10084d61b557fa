#include "human_study/study/run/usual_hands.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** What happens to a hand before its labels are written down. */
enum class Change { kNone, kThumbForIndex, kIndexForMiddle, kTurned, kMirrored };

/** Of a person whose hand comes from -y: the thumb 30 mm nearer to the wrist than the fingers. */
class HandsTest : public ::testing::Test {
 protected:
  ReachTrial Reach(Change change) {
    std::vector<Vector3d> places = {{-0.05, -0.03, 0.0}, {0.05, 0.0, 0.011}, {0.05, 0.0, -0.011}};
    for (Vector3d& place : places) {
      if (change == Change::kTurned) place = Vector3d(-place.x(), place.y(), -place.z());
      if (change == Change::kMirrored) place.x() *= -1.0;
      place += 2e-3 * Vector3d(random_.NextNormal(), random_.NextNormal(), random_.NextNormal());
    }
    if (change == Change::kThumbForIndex) std::swap(places[0], places[1]);
    if (change == Change::kIndexForMiddle) std::swap(places[1], places[2]);
    ReachTrial reach;
    reach.times = MakeTimes(0.0, 1.0, 100.0);
    const char* const names[] = {"TH", "FF", "MF"};
    const auto follow = [&](const Vector3d& place) {
      return SamplePath(reach.times, [&](double t) -> Vector3d {
        return place + Vector3d(0, 0.3 * Ease(t, 0.1, 0.8), 0);
      });
    };
    for (size_t d = 0; d < 3; ++d) {
      reach.digits.emplace_back().digit = names[d];
      reach.digits.back().tip = follow(places[d]);
    }
    if (has_wrist_) reach.wrist = follow({0.0, -0.15, 0.0});
    return reach;
  }

  void Add(int count, Change change = Change::kNone) {
    for (int i = 0; i < count; ++i) hands_.Add(planned_, analysis_, Reach(change));
  }
  /** The text; empty: no doubt. */
  std::string Find(Change change) {
    const std::vector<Doubt> doubts = hands_.FindExchange(planned_, analysis_, Reach(change));
    if (doubts.empty()) return "";
    EXPECT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].code, "labels_exchanged");
    return doubts[0].text;
  }

  void SetUp() override {
    planned_.participant = "P1";
    planned_.object = "box";
    analysis_.movement.onset.time = 0.1;
    analysis_.hold.time = 0.9;
  }

  PlannedReach planned_;
  TrialAnalysis analysis_;
  UsualHands hands_;
  bool has_wrist_ = true;
  RandomStream random_{"usual hands", "places"};
};

TEST_F(HandsTest, ALabelOfTheWrongDigitIsToldByBothNames) {
  Add(6);
  EXPECT_EQ(Find(Change::kNone), "");
  const std::string text = Find(Change::kThumbForIndex);
  ExpectHolds(text, "thumb and index are where index and thumb are in the person's other trials");
  // |q - m| = 2 |m|, of (0.1, 0.03, 0.011) and the distances to the wrist, 0.130 and 0.158 m.
  const double apart = 2.0 * std::hypot(0.1, 0.03, std::hypot(0.011, 0.0287));
  const double told = std::stod(text.substr(text.find("trials: ") + 8));
  EXPECT_NEAR(told, 1e3 * apart, 12.0);
  ExpectHolds(Find(Change::kIndexForMiddle), "index and middle are where middle and index are");
  analysis_.hold.time = kUnset;
  EXPECT_EQ(Find(Change::kThumbForIndex), "") << "no hold";
}

TEST_F(HandsTest, OneExchangedAmongThoseThatWereLearnedHidesNothing) {
  Add(2);
  EXPECT_EQ(Find(Change::kThumbForIndex), "") << "two trials show nothing usual";
  Add(1, Change::kThumbForIndex);
  EXPECT_EQ(Find(Change::kNone), "");
  EXPECT_NE(Find(Change::kThumbForIndex), "");
  Add(2, Change::kThumbForIndex);
  EXPECT_EQ(Find(Change::kThumbForIndex), "") << "three of five are not two thirds";
  EXPECT_EQ(Find(Change::kNone), "");
}

// The thumb of a hand that was turned round is as near to the wrist as before.
TEST_F(HandsTest, ATurnedHandIsNone) {
  Add(6);
  EXPECT_EQ(Find(Change::kTurned), "");
}

TEST_F(HandsTest, AnotherHandAndAnotherWayToHoldAnObjectAreLearnedApart) {
  has_wrist_ = false;
  Add(6);
  EXPECT_NE(Find(Change::kMirrored), "") << "nobody said that it is another hand";
  planned_.hand = "left";
  EXPECT_EQ(Find(Change::kMirrored), "");
  Add(3, Change::kMirrored);
  EXPECT_EQ(Find(Change::kMirrored), "");
  EXPECT_NE(Find(Change::kNone), "");
  planned_.hand = "";
  planned_.object = "handle";
  EXPECT_NE(Find(Change::kMirrored), "") << "as on any object";
  Add(3, Change::kMirrored);
  EXPECT_EQ(Find(Change::kMirrored), "");
  planned_.participant = "P2";
  EXPECT_EQ(Find(Change::kThumbForIndex), "") << "nothing is known of that person";
}

}  // namespace
}  // namespace graspbench
