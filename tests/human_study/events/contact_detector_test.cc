#include "human_study/events/contact_detector.h"

#include <gtest/gtest.h>

#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

/** Straight lines through corners of time [s] and departure [m], 200 Hz. */
ScalarCurve MakeDeparture(const std::vector<std::pair<double, double>>& corners) {
  return SampleCurve(MakeTimes(0.0, corners.back().first, 200.0), [&](double t) {
    size_t piece = 0;
    while (piece + 2 < corners.size() && t > corners[piece + 1].first) ++piece;
    const auto [t0, y0] = corners[piece];
    const auto [t1, y1] = corners[piece + 1];
    return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
  });
}

TEST(FindRegrasp, NamesTouchReleaseAndWay) {
  // There at 0.5 s, leaves at 0.6 s, 9 mm away at 0.7 s, back at 0.8 s.
  const ScalarCurve departure =
      MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {0.6, 0.0}, {0.7, 9e-3}, {0.8, 0.0}, {1.2, 0.0}});
  const Regrasp regrasp = FindRegrasp(departure, 0.1, 0.8);
  ASSERT_TRUE(regrasp.IsFound());
  EXPECT_NEAR(regrasp.first_touch.time, 0.49, 0.005);  // 2 mm at 0.2 m/s before
  EXPECT_NEAR(regrasp.release.time, 0.6 + 0.1 * 2.0 / 9.0, 0.005);
  EXPECT_NEAR(regrasp.left_by, 9e-3, 0.3e-3);
}

// Two detectors 0.3 s apart both claim 5 ms: the interval of the believed one reaches the other.
TEST(CoverDisagreement, TheIntervalReachesTheOtherDetector) {
  DigitContactEvents digit;
  digit.contact.time = 1.0;
  digit.contact.uncertainty = 0.005;
  digit.by_detector.assign(ContactDetectorList().size(), digit.contact);
  std::vector<DigitContactEvents> contacts = {digit};
  EventTime& other = contacts[0].by_detector[FindContactDetector("surface")];
  EventTime& rough = contacts[0].by_detector[FindContactDetector("speed")];
  rough.time = 0.5;  // a threshold, which slow arrivals cross early
  other.time = 1.09;
  const ContactOptions options;
  CoverDisagreement(0.1, options, contacts);
  EXPECT_EQ(contacts[0].contact.uncertainty, 0.005);
  other.time = 0.7;
  CoverDisagreement(0.0, options, contacts);
  EXPECT_EQ(contacts[0].contact.uncertainty, 0.005);
  contacts[0].is_reviewed = true;
  CoverDisagreement(0.1, options, contacts);
  EXPECT_EQ(contacts[0].contact.uncertainty, 0.005);
  contacts[0].is_reviewed = false;
  CoverDisagreement(0.1, options, contacts);
  EXPECT_NEAR(contacts[0].contact.CalcHalfWidth(), 0.3, 1e-12);
  EXPECT_TRUE(IsUnresolved(contacts[0].contact));
  EXPECT_EQ(contacts[0].contact.missing, "not usable here: known to \u00b1 300 ms only");
  EXPECT_EQ(contacts[0].contact.time, 1.0);
}

// Three fingers press against one thumb, whose skin bears their sum.
TEST(FindNoTouch, AThumbMayMoveByWhatAllFingersPress) {
  DigitTrack thumb, finger;
  thumb.is_thumb = true;
  ContactEvidence evidence;
  evidence.hold = {1.0, 0.9, 1.5, ""};
  evidence.typical_looseness = 0.5e-3;
  evidence.digits.resize(4);
  DigitEvidence& digit = evidence.digits[0];
  digit.speed = SampleCurve(MakeTimes(0.0, 2.0, 100.0), [](double) { return 0.0; });
  digit.noise_O = 0.0;
  const auto touches = [&](const DigitTrack& track, double looseness) {
    digit.track = &track;
    digit.looseness = looseness;
    return FindNoTouch(evidence, digit, {}).empty();
  };
  EXPECT_TRUE(touches(finger, 1.4e-3));
  EXPECT_FALSE(touches(finger, 1.6e-3));
  EXPECT_TRUE(touches(thumb, 4.4e-3));
  EXPECT_FALSE(touches(thumb, 4.6e-3));
}

TEST(FindRegrasp, OneTouchAndNoiseAreNone) {
  const ScalarCurve once = MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {1.2, 0.0}});
  EXPECT_FALSE(FindRegrasp(once, 0.1, 0.5).IsFound());
  ScalarCurve noisy =
      MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {0.6, 0.0}, {0.7, 5e-3}, {0.8, 0.0}, {1.2, 0.0}});
  EXPECT_TRUE(FindRegrasp(noisy, 0.1, 0.8).IsFound());
  noisy.noise = 1e-3;
  EXPECT_FALSE(FindRegrasp(noisy, 0.1, 0.8).IsFound());
}

}  // namespace
}  // namespace graspbench
