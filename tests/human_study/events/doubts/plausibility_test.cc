#include "human_study/events/doubts/plausibility.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/human_study/events/trajectories.h"
#include "tests/human_study/faults.h"

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

TEST(FindUnseenCarrying, IsALongWayOfDigitsThatKeepTheirDistance) {
  const Hold hold = {2.0, 1.9, 2.0, ""};
  EXPECT_NEAR(CalcJointTravel(MakeTips(0.1), hold), 0.1, 1e-9);
  EXPECT_NEAR(CalcJointTravel(MakeTips(0.0), hold), 0.0, 1e-9);
  const auto doubts = FindUnseenCarrying(MakeTips(0.1), hold, {});
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "carried_unseen");
  EXPECT_TRUE(FindUnseenCarrying(MakeTips(0.03), hold, {}).empty());
}

/** Digits that rest at these places [m]. */
std::vector<DigitTrack> PlaceDigits(const std::vector<Vector3d>& places) {
  const char* const names[] = {"TH", "FF", "MF", "RF"};
  std::vector<DigitTrack> digits(places.size());
  for (size_t d = 0; d < places.size(); ++d) {
    digits[d].digit = names[d];
    digits[d].tip = SamplePath(MakeTimes(0, 1, 100), [&](double) { return places[d]; });
  }
  return digits;
}

/** The doubt's text; "" without any. */
std::string FindUnitText(const std::vector<DigitTrack>& digits, const std::string& code) {
  const std::vector<Doubt> doubts = FindWrongUnit(digits);
  if (doubts.empty()) return "";
  EXPECT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, code);
  return doubts[0].text;
}

TEST(FindWrongUnit, NamesTheUnitThatWouldExplainTheHand) {
  const auto text = [](double factor) {
    std::vector<DigitTrack> digits(2);
    for (size_t d = 0; d < 2; ++d) {
      digits[d].tip = MakeTips(0.0)[d].path;
      digits[d].tip.p *= factor;
    }
    return FindUnitText(digits, "wrong_unit");
  };
  // 0.2: a small hand that pinches.
  for (const double factor : {0.2, 1.0, 3.0}) EXPECT_EQ(text(factor), "") << factor;
  const std::pair<double, const char*> named[] = {
      {10.0, "millimetres read as centimetres"}, {0.1, "centimetres read as millimetres"},
      {30.0, "millimetres read as inches"},      {1000.0, "millimetres read as metres"},
      {100.0, "centimetres read as metres"},     {1e-3, "metres read as millimetres"}};
  for (const auto& [factor, name] : named) ExpectHolds(text(factor), name);
}

TEST(FindWrongUnit, NoReachIsFasterThanFiveMetresASecond) {
  const auto text = [](double speed) {
    std::vector<DigitTrack> digits(3);
    for (size_t d = 0; d < 3; ++d) {
      digits[d].tip = SamplePath(MakeTimes(0, 1, 200), [&](double t) {
        return Vector3d(speed * t, 0.05 * static_cast<double>(d), 0);
      });
    }
    digits[0].tip.p.col(50).x() += 1.0;  // one marker's outlier is no speed of the hand
    return FindUnitText(digits, "wrong_unit");
  };
  EXPECT_EQ(text(4.9), "");
  EXPECT_NE(text(5.1), "");
}

// 0.35 m between two digits: no unit makes a usual hand of it, exchanged columns would.
TEST(FindWrongUnit, WhatNoUnitExplainsWellMayBeExchangedColumnsOrOneDigit) {
  const auto text = [](double span) {
    return FindUnitText(PlaceDigits({{0, 0, 0}, {span, 0, 0}}), "wrong_unit");
  };
  ExpectHolds(text(0.35), "columns (mapping) or two markers' labels are exchanged");
  EXPECT_EQ(text(0.9).find("exchanged"), std::string::npos);
  // Left on the table.
  ExpectHolds(FindUnitText(PlaceDigits({{0, 0, 0}, {0, 0.03, 0}, {0, 0.06, 0}, {0.6, 0.09, 0}}),
                           "far_digit"),
              "digit RF");
  // Ten times a hand whose thumb is 90 mm from fingers 25 mm apart: without the thumb the span is
  // still no hand's.
  EXPECT_NE(FindUnitText(PlaceDigits({{-0.9, 0, 0}, {0, 0, 0}, {0.25, 0, 0}}), "wrong_unit"), "");
}

/** Three digits 40 mm apart that reach 0.4 m in 1 s with a peak speed of 0.75 m/s. */
std::vector<DigitTrack> MakeReach(double rate) {
  std::vector<DigitTrack> digits(3);
  const char* const names[] = {"TH", "FF", "MF"};
  for (size_t d = 0; d < 3; ++d) {
    digits[d].digit = names[d];
    digits[d].tip = SamplePath(MakeTimes(0, 1, rate), [&](double t) {
      return Vector3d(0.4 * Ease(t, 0, 1), 0.04 * static_cast<double>(d), 0);
    });
  }
  return digits;
}

TEST(FindLabelJump, ExchangedLabelsAreNamedAndOutliersAreNot) {
  for (const double rate : {100.0, 200.0, 500.0}) {
    const std::vector<DigitTrack> good = MakeReach(rate);
    EXPECT_TRUE(FindLabelJump(good).empty());
    const auto half = static_cast<Eigen::Index>(rate / 2);
    std::vector<DigitTrack> spike = good;
    spike[1].tip.p.col(half).y() += 0.1;
    EXPECT_TRUE(FindLabelJump(spike).empty());
    spike[1].tip.p.middleCols(half, 3).colwise() += Vector3d(0, 0.1, 0);
    EXPECT_TRUE(FindLabelJump(spike).empty());
    std::vector<DigitTrack> exchanged = good;
    const Eigen::Index rest = good[0].tip.p.cols() - half;
    exchanged[0].tip.p.rightCols(rest) = good[1].tip.p.rightCols(rest);
    exchanged[1].tip.p.rightCols(rest) = good[0].tip.p.rightCols(rest);
    const std::vector<Doubt> doubts = FindLabelJump(exchanged);
    ASSERT_EQ(doubts.size(), 1u) << rate;
    EXPECT_EQ(doubts[0].code, "label_jump");
    ExpectHolds(doubts[0].text, "at 0.500 s");
  }
}

TEST(FindNoMovement, ARestingHandIsNoReach) {
  std::vector<DigitTrack> digits = MakeReach(100.0);
  EXPECT_TRUE(FindNoMovement(digits).empty());
  for (DigitTrack& digit : digits) digit.tip.p *= 0.04;  // 16 mm
  ASSERT_EQ(FindNoMovement(digits).size(), 1u);
  ExpectHolds(FindNoMovement(digits)[0].text, "farther than 16.0 mm in 1.00 s");
}

TEST(FindHandCentred, AHandThatOnlyOpensAboutTheOriginIsNoReach) {
  const std::vector<double> times = MakeTimes(0, 1, 100);
  double hidden_until = 0.3;
  const auto doubts = [&](double reach, const Vector3d& place) {
    std::vector<DigitTrack> digits(2);
    for (size_t d = 0; d < 2; ++d) {
      const double side = d == 0 ? -1.0 : 1.0;
      digits[d].tip = SamplePath(times, [&](double t) {
        return Vector3d(place + Vector3d(side * (0.03 + 0.02 * std::sin(3.0 * t)), reach * t, 0));
      });
    }
    HideSamples(digits[1].tip, 0.2, hidden_until);
    return FindHandCentred(digits);
  };
  ASSERT_EQ(doubts(0.01, Vector3d(0, 0.05, 0)).size(), 1u);
  EXPECT_EQ(doubts(0.01, Vector3d(0, 0.05, 0))[0].code, "hand_centred");
  ExpectHolds(doubts(0.01, Vector3d(0, 0.05, 0))[0].text,
              "within 60 mm of the origin and moves 10");
  EXPECT_TRUE(doubts(0.3, Vector3d(0, 0, 0)).empty());     // reaches through the origin
  EXPECT_TRUE(doubts(0.01, Vector3d(0.4, 0, 0)).empty());  // rests elsewhere: no landmark's frame
  hidden_until = 0.9;  // markers that are missing are no hand's frame
  EXPECT_TRUE(doubts(0.01, Vector3d(0, 0.05, 0)).empty());
}

TEST(FindWrongShape, MarkersInsideTheSolidAndFarFromItAreNamed) {
  bool is_lifted = true;
  const auto text = [&](double first, double second, bool has_pad_offset) -> std::string {
    std::vector<DigitContactEvents> contacts(2);
    contacts[0].hold_distance = first;
    contacts[1].hold_distance = second;
    contacts[0].has_pad_offset = contacts[1].has_pad_offset = has_pad_offset;
    const auto doubts = FindWrongShape(contacts, is_lifted, {});
    return doubts.empty() ? "" : doubts.front().text;
  };
  EXPECT_EQ(text(0.008, 0.014, false), "");
  ExpectHolds(text(-0.004, -0.002, false), "3 mm inside");
  ExpectHolds(text(-0.004, -0.002, false), "too large");
  ExpectHolds(text(0.024, 0.022, false), "too small");
  EXPECT_EQ(text(0.002, -0.002, true), "");
  ExpectHolds(text(-0.007, -0.009, true), "8 mm nearer to");
  EXPECT_EQ(text(std::nan(""), 0.03, false), "");  // one digit is no majority
  EXPECT_EQ(text(0.024, 0.022, false).find("recording ends"), std::string::npos);
  is_lifted = false;
  ExpectHolds(text(0.024, 0.022, false), "or the recording ends before they are at the object");
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
  object.lift_off = digit.contact;
  object.lift_off.time = 1.7;  // the wrist waits while the digits close, then lifts
  EXPECT_EQ(code(0.5), "");
  object.lift_off.time = 1.3;
  EXPECT_EQ(code(0.5), "contact_after_end");
  object.lift_off = MissingEvent("none");
  movement.end.time = 1.4;
  object.moved = digit.contact;
  object.moved.time = 1.4;
  EXPECT_EQ(code(0.5), "moved_before_touch");
  DigitContactEvents unresolved = digit;  // perhaps the first
  unresolved.contact.missing = std::string(kNotUsable) + ": known to \u00b1 200 ms only";
  EXPECT_TRUE(FindContactDoubts({digit, unresolved}, movement, object, 0.5, {}).empty());
}

/** Code of the doubt about the direction of a lift along `up`. */
std::string FindAxisCode(const Vector3d& up, const std::function<Vector3d(double)>& way) {
  ReachTrial trial;
  trial.times = MakeTimes(0, 3, 100);
  for (const double t : trial.times) {
    trial.object.X_LO.push_back(MakePose(way(t)));
    trial.object.states.push_back(SampleState::kMeasured);
  }
  LiftOffOptions options;
  options.up_x = up.x();
  options.up_y = up.y();
  options.up_z = up.z();
  const ObjectTravel travel = CalcObjectTravel(trial, options);
  const auto doubts =
      FindOtherLiftAxis(travel, FindObjectEvents(travel, options), options, PlausibilityOptions());
  if (doubts.empty()) return "";
  return doubts[0].text.substr(doubts[0].text.find("up_x"));
}

// What is lifted and carried aside rises along a wrong axis, too, but later.
TEST(FindOtherLiftAxis, AThingRisesBeforeItGoesAside) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const std::string is_z = "up_x: 0, up_y: 0, up_z: 1}";
  const auto lift = [&](double height, double aside, double delay) {
    return [=](double t) -> Vector3d {
      return height * Ease(t, 1.0, 2.0) * z + aside * Ease(t, 1.0 + delay, 2.0 + delay) * y;
    };
  };
  EXPECT_EQ(FindAxisCode(z, lift(0.12, 0.0, 0.0)), "");
  EXPECT_EQ(FindAxisCode(y, lift(0.12, 0.0, 0.0)), is_z);
  EXPECT_EQ(FindAxisCode(y, lift(0.12, 0.03, 0.15)), is_z);
  EXPECT_EQ(FindAxisCode(y, lift(0.12, 0.07, 0.15)), is_z);
  EXPECT_EQ(FindAxisCode(-z, lift(-0.12, 0.03, 0.15)), "");
  EXPECT_EQ(FindAxisCode(z, lift(0.03, 0.3, 0.2)), "");
  EXPECT_EQ(FindAxisCode(z, lift(0.06, 0.3, 0.0)), "") << "both ways at once";
  // Pushed before it is lifted.
  EXPECT_EQ(FindAxisCode(z,
                         [&](double t) -> Vector3d {
                           return 0.015 * Ease(t, 0.4, 1.4) * x + 0.1 * Ease(t, 1.0, 2.0) * z;
                         }),
            "");
}

}  // namespace
}  // namespace graspbench
