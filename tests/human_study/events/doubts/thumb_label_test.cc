#include "human_study/events/doubts/thumb_label.h"

#include <gtest/gtest.h>

#include <map>

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Places = std::map<std::string, Vector3d>;

/** An open hand: the tips of the fingers 20 mm apart, the thumb 80 mm off their row. */
const Places kHand = {{"TH", {0.01, -0.08, 0.0}},
                      {"FF", {0.0, 0.0, 0.0}},
                      {"MF", {0.02, 0.0, 0.0}},
                      {"RF", {0.04, 0.0, 0.0}},
                      {"LF", {0.06, 0.0, 0.0}}};
const Vector3d kWrist(0.0, -0.11, -0.1);  // 105 mm from the thumb, 149 from the index

Trajectory MakePath(const Vector3d& place) {
  constexpr size_t kNumSamples = 20;
  Trajectory path;
  path.p.resize(3, kNumSamples);
  path.states.assign(kNumSamples, SampleState::kMeasured);
  for (size_t i = 0; i < kNumSamples; ++i) {
    path.times.push_back(0.01 * static_cast<double>(i));
    path.p.col(static_cast<Eigen::Index>(i)) = place;
  }
  return path;
}

struct Case {
  ReachTrial trial;
  std::vector<DigitContactEvents> contacts;
  ThumbCheck Check() const { return CheckThumb(trial, contacts, 0.1); }
};

Case MakeCase(const std::vector<std::string>& digits, const Places& places, bool has_wrist) {
  Case made;
  for (const std::string& digit : digits) {
    DigitTrack& track = made.trial.digits.emplace_back();
    track.digit = digit;
    track.is_thumb = digit == "TH";
    track.tip = MakePath(places.at(digit));
    made.contacts.emplace_back().by_detector.emplace_back().time = 0.1;
  }
  made.trial.times = made.trial.digits[0].tip.times;
  if (has_wrist) made.trial.wrist = MakePath(kWrist);
  return made;
}

Places Exchange(Places places, const char* finger) {
  std::swap(places["TH"], places[finger]);
  return places;
}

TEST(CheckThumb, TheRowOfFingersTellsTheThumb) {
  using Digits = std::vector<std::string>;
  for (const Digits& digits : {Digits{"TH", "FF", "MF", "RF", "LF"}, Digits{"TH", "FF", "MF"}}) {
    EXPECT_EQ(MakeCase(digits, kHand, false).Check().label, ThumbLabel::kTold);
    const ThumbCheck check = MakeCase(digits, Exchange(kHand, "FF"), false).Check();
    EXPECT_EQ(check.label, ThumbLabel::kExchanged);
    EXPECT_NE(check.text.find("thumb and digit FF exchanged"), std::string::npos) << check.text;
  }
  // Less far off the row, only the wrist makes it sure.
  Places near = kHand;
  near["TH"] = {0.01, -0.06, 0.0};
  for (const bool has_wrist : {true, false}) {
    EXPECT_EQ(
        MakeCase({"TH", "FF", "MF", "RF", "LF"}, Exchange(near, "FF"), has_wrist).Check().label,
        has_wrist ? ThumbLabel::kExchanged : ThumbLabel::kUnlikely);
  }
  const Digits all = {"TH", "FF", "MF", "RF", "LF"};
  const ThumbCheck ring = MakeCase(all, Exchange(kHand, "RF"), false).Check();
  EXPECT_NE(
      ring.text.find("a row of 195 mm, with the labels of thumb and digit RF exchanged of 60"),
      std::string::npos)
      << ring.text;
}

TEST(CheckThumb, WithoutARowTheWristTellsIt) {
  for (const std::vector<std::string>& digits :
       {std::vector<std::string>{"TH", "FF"}, std::vector<std::string>{"TH", "FF", "LF"}}) {
    EXPECT_EQ(MakeCase(digits, kHand, true).Check().label, ThumbLabel::kTold);
    EXPECT_EQ(MakeCase(digits, Exchange(kHand, "FF"), true).Check().label, ThumbLabel::kUnlikely);
    EXPECT_EQ(MakeCase(digits, kHand, false).Check().label, ThumbLabel::kNotTold);
  }
  // A thumb as long as a finger.
  Places equal = kHand;
  equal["TH"] = {0.01, -0.01, 0.02};
  EXPECT_EQ(MakeCase({"TH", "FF"}, equal, true).Check().label, ThumbLabel::kNotTold);
}

TEST(CheckThumb, WhatContradictsItselfIsNotTold) {
  // The others are curled beside the thumb.
  Places curled = kHand;
  curled["MF"] = {0.03, -0.06, 0.0};
  curled["RF"] = {0.05, -0.06, 0.0};
  curled["LF"] = {0.07, -0.06, 0.0};
  const std::vector<std::string> all = {"TH", "FF", "MF", "RF", "LF"};
  EXPECT_EQ(MakeCase(all, curled, true).Check().label, ThumbLabel::kNotTold);
  EXPECT_EQ(MakeCase(all, Exchange(curled, "FF"), true).Check().label, ThumbLabel::kNotTold);
  // Where they are seen not to touch, the wrist alone is asked.
  Case seen = MakeCase(all, curled, true);
  for (size_t d = 2; d < 5; ++d) seen.contacts[d].by_detector[0] = MissingEvent("it stays away");
  EXPECT_EQ(seen.Check().label, ThumbLabel::kTold);
}

// The wrist of a recording may be anywhere on the arm: a sure row is believed.
TEST(CheckThumb, ASureRowIsBelievedAgainstTheWrist) {
  const std::vector<std::string> all = {"TH", "FF", "MF", "RF", "LF"};
  Places far = kHand;
  far["TH"] = {0.01, -0.1, 0.0};
  Case right = MakeCase(all, far, true), exchanged = MakeCase(all, Exchange(far, "FF"), true);
  right.trial.wrist = exchanged.trial.wrist = MakePath({0.0, 0.05, 0.0});
  EXPECT_EQ(right.Check().label, ThumbLabel::kTold);
  EXPECT_EQ(exchanged.Check().label, ThumbLabel::kExchanged);
}

TEST(CheckThumb, ARecordingWithoutAThumbHasNothingToExchange) {
  EXPECT_EQ(MakeCase({"FF", "MF"}, kHand, false).Check().label, ThumbLabel::kTold);
}

}  // namespace
}  // namespace graspbench
