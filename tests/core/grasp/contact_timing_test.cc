#include "core/grasp/contact_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.h"

namespace graspbench {
namespace {

constexpr double kNeverTouches = std::numeric_limits<double>::quiet_NaN();

// Times in eighths of a second are exact in binary, so the expected differences are exact too.
std::vector<DigitContact> MakeHand(double thumb, const std::vector<double>& fingers) {
  std::vector<DigitContact> contacts{{"TH", true, thumb}};
  const char* const names[] = {"FF", "MF", "RF", "LF"};
  for (size_t i = 0; i < fingers.size(); ++i) contacts.push_back({names[i], false, fingers[i]});
  return contacts;
}

TEST(ContactTiming, ThumbFirst) {
  const ContactTiming timing = CalcContactTiming(MakeHand(0.25, {0.5, 0.375, 0.75}), 0.0);
  EXPECT_EQ(timing.gct, 0.75);
  EXPECT_EQ(timing.gft, 0.5);
  EXPECT_EQ(timing.got, 0.125);
  EXPECT_DOUBLE_EQ(timing.gft_ratio, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(timing.got_ratio, 1.0 / 6.0);
  EXPECT_FALSE(timing.contact_before_start);
}

TEST(ContactTiming, ThumbLast) {
  const ContactTiming timing = CalcContactTiming(MakeHand(1.0, {0.5, 0.625}), 0.25);
  EXPECT_EQ(timing.gct, 0.75);
  EXPECT_EQ(timing.gft, 0.5);
  EXPECT_EQ(timing.got, 0.5);
}

// The thumb opposes the first finger to arrive, not the closest in time.
TEST(ContactTiming, ThumbInTheMiddle) {
  const ContactTiming timing = CalcContactTiming(MakeHand(0.5, {0.125, 0.625}), 0.0);
  EXPECT_EQ(timing.gft, 0.5);
  EXPECT_EQ(timing.got, 0.375);
}

TEST(ContactTiming, TwoDigitsFormAsTheyOppose) {
  for (const auto& [thumb, finger] : {std::pair(0.3, 0.7), std::pair(0.7, 0.3)}) {
    const ContactTiming timing = CalcContactTiming(MakeHand(thumb, {finger}), 0.1);
    EXPECT_EQ(timing.gft, timing.got);
    EXPECT_EQ(timing.gft, 0.7 - 0.3);
  }
}

TEST(ContactTiming, AFingerThatNeverTouchesLeavesOnlyOpposition) {
  const ContactTiming timing = CalcContactTiming(MakeHand(0.25, {0.5, kNeverTouches}), 0.0);
  EXPECT_TRUE(std::isnan(timing.gct));
  EXPECT_TRUE(std::isnan(timing.gft));
  EXPECT_EQ(timing.got, 0.25);
  EXPECT_TRUE(std::isnan(timing.gft_ratio));
  EXPECT_TRUE(std::isnan(timing.got_ratio));
}

TEST(ContactTiming, WithoutTheThumbNothingOpposes) {
  for (const std::vector<DigitContact>& contacts :
       {MakeHand(kNeverTouches, {0.5, 0.75}), MakeHand(0.5, {kNeverTouches, kNeverTouches})}) {
    const ContactTiming timing = CalcContactTiming(contacts, 0.0);
    EXPECT_TRUE(std::isnan(timing.got));
    EXPECT_TRUE(std::isnan(timing.got_ratio));
    EXPECT_TRUE(std::isnan(timing.gct));
  }
}

TEST(ContactTiming, AHandWithoutThumbStillForms) {
  const ContactTiming timing = CalcContactTiming({{"FF", false, 0.25}, {"MF", false, 0.75}}, 0.125);
  EXPECT_EQ(timing.gct, 0.625);
  EXPECT_EQ(timing.gft, 0.5);
  EXPECT_TRUE(std::isnan(timing.got));
}

TEST(ContactTiming, NoDigitsNoTimes) {
  const ContactTiming timing = CalcContactTiming({}, 0.0);
  EXPECT_TRUE(std::isnan(timing.gct));
  EXPECT_TRUE(std::isnan(timing.gft));
  EXPECT_TRUE(std::isnan(timing.got));
  EXPECT_FALSE(timing.contact_before_start);
}

TEST(ContactTiming, AllTouchAtTheStart) {
  const ContactTiming timing = CalcContactTiming(MakeHand(2.0, {2.0, 2.0}), 2.0);
  EXPECT_EQ(timing.gct, 0.0);
  EXPECT_EQ(timing.gft, 0.0);
  EXPECT_EQ(timing.got, 0.0);
  EXPECT_TRUE(std::isnan(timing.gft_ratio));
  EXPECT_TRUE(std::isnan(timing.got_ratio));
  EXPECT_FALSE(timing.contact_before_start);
}

TEST(ContactTiming, ContactBeforeTheStartIsToldNotClipped) {
  const ContactTiming timing = CalcContactTiming(MakeHand(0.25, {0.75, 1.0}), 0.5);
  EXPECT_TRUE(timing.contact_before_start);
  EXPECT_EQ(timing.gct, 0.5);
  EXPECT_EQ(timing.gft, 0.75);  // longer than the closure itself
  EXPECT_EQ(timing.got, 0.5);
  EXPECT_EQ(timing.gft_ratio, 1.5);
}

TEST(ContactTiming, AllBeforeTheStartHasNoRatios) {
  const ContactTiming timing = CalcContactTiming(MakeHand(0.25, {0.375}), 0.5);
  EXPECT_TRUE(timing.contact_before_start);
  EXPECT_EQ(timing.gct, -0.125);
  EXPECT_TRUE(std::isnan(timing.gft_ratio));
}

// GCT >= GFT >= GOT for every hand that touches after the start, and the order of the digits and
// the zero of the clock do not matter.
TEST(ContactTiming, OrderOfTheThreeMeasures) {
  RandomStream stream("contact timing", "order");
  for (int i = 0; i < 2000; ++i) {
    const double t0 = stream.NextUniform(-1.0, 1.0);
    std::vector<double> fingers(1 + stream.NextIndex(4));
    for (double& time : fingers) time = t0 + stream.NextUnit();
    std::vector<DigitContact> contacts = MakeHand(t0 + stream.NextUnit(), fingers);
    const ContactTiming timing = CalcContactTiming(contacts, t0);
    ASSERT_GE(timing.gct, timing.gft);
    ASSERT_GE(timing.gft, timing.got);
    ASSERT_GE(timing.got, 0.0);
    ASSERT_LE(timing.gft_ratio, 1.0);
    if (fingers.size() == 1) {
      ASSERT_EQ(timing.gft, timing.got);
    }

    std::swap(contacts.front(), contacts.back());
    for (DigitContact& contact : contacts) contact.time += 8.0;
    const ContactTiming later = CalcContactTiming(contacts, t0 + 8.0);
    ASSERT_NEAR(later.gct, timing.gct, 1e-14);
    ASSERT_NEAR(later.gft, timing.gft, 1e-14);
    ASSERT_NEAR(later.got, timing.got, 1e-14);
  }
}

TEST(ContactTimingDeathTest, TwoThumbsAreABug) {
  EXPECT_DEATH(CalcContactTiming({{"TH", true, 0.1}, {"T2", true, 0.2}}, 0.0),
               "opposing digits: 2");
}

}  // namespace
}  // namespace graspbench
