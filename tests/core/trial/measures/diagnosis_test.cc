#include "core/trial/measures/diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/trial/measures/load_recorder.h"
#include "core/trial/trial_result.h"

namespace graspbench {
namespace {

constexpr double kClosure = 1.0, kLiftOff = 2.0, kEnd = 3.0;  // since the start of placing [s]

PartSample MakePart(double force) {
  PartSample part;
  part.force = static_cast<float>(force);
  part.friction = force > 0.0 ? 0.6f : 0.0f;
  part.closing = 1.0f;
  return part;
}

/** Thumb and two fingers that press from 1.5 s on; from `lost_at` on all slip. */
struct Story {
  TrialResult result;
  std::vector<LoadSample> samples;

  explicit Story(double lost_at, double force = 2.0) {
    result.outcome = Outcome::kSlippedInLiftOff;
    result.weight = 1.0;
    result.contacts = {{"TH", true, 0.5}, {"FF", false, 0.5}, {"MF", false, 0.5}};
    result.touches.resize(3);
    result.phases = {{NameOf(Phase::kClosure), 0.0},
                     {NameOf(Phase::kLiftOff), kLiftOff - kClosure}};
    for (double time = 0.01; time < kEnd; time += 0.01) {
      LoadSample sample;
      sample.time = time;
      sample.parts = {MakePart(0.0), MakePart(0.0), MakePart(0.0), MakePart(0.0)};
      for (size_t part = 0; part < 3 && time >= 1.5; ++part) {
        sample.parts[part] = MakePart(part == 0 ? 2.0 * force : force);
        sample.parts[part].is_sliding = time >= lost_at + 0.02 * static_cast<double>(part);
      }
      samples.push_back(sample);
    }
  }
  Diagnosis Find() const { return *FindDiagnosis(result, samples, kClosure); }
  template <class Change>
  void ForEach(Change&& change) {
    for (LoadSample& sample : samples) change(sample);
  }
  /** The diagnosis has this cause, blames this digit and says this. */
  void Expect(FailureCause cause, const std::string& digit = "", const char* text = "") const {
    const Diagnosis found = Find();
    EXPECT_STREQ(NameOf(found.cause), NameOf(cause));
    EXPECT_EQ(found.digit, digit);
    EXPECT_NE(found.text.find(text), std::string::npos) << found.text;
  }
};

TEST(Diagnosis, ASuccessAndAnUnreachableObjectHaveNone) {
  Story story(2.2);
  for (const Outcome outcome : {Outcome::kSuccess, Outcome::kUnreachable, Outcome::kNotSeen}) {
    story.result.outcome = outcome;
    EXPECT_FALSE(FindDiagnosis(story.result, story.samples, kClosure));
  }
}

TEST(Diagnosis, TheFirstToSlipForGoodGaveWay) {
  const Diagnosis found = Story(2.2).Find();
  EXPECT_EQ(found.lost, "TH");
  EXPECT_NEAR(found.time, 2.2, 0.011);
  EXPECT_DOUBLE_EQ(found.force, 4.0);
  EXPECT_DOUBLE_EQ(found.others, 4.0);
  Story story(2.6);  // a slip that ends is no loss
  story.ForEach([](auto& s) { s.parts[1].is_sliding |= s.time > 2.1 && s.time < 2.3; });
  EXPECT_EQ(story.Find().lost, "TH");
  EXPECT_NEAR(story.Find().time, 2.6, 0.011);
}

// While the table bears it, a grip is not too weak.
TEST(Diagnosis, FrictionThatCannotBearTheWeightIsAWeakGrip) {
  Story weak(2.2, 0.3);  // 0.6 (0.6 + 0.3 + 0.3) N = 0.72 N of 1 N
  weak.Expect(FailureCause::kWeakGrip);
  EXPECT_NEAR(weak.Find().bearable, 0.72, 1e-6);
  weak.ForEach([](auto& s) { s.is_on_table = s.time < 2.1; });
  weak.Expect(FailureCause::kWeakGrip);
  weak.ForEach([](auto& s) { s.is_on_table = true; });
  weak.Expect(FailureCause::kNotIdentified);
  Story(2.2, 2.0).Expect(FailureCause::kTurned);
}

// 0.6 (4 + 2 + 2) N = 4.8 N bears the weight of 1 N, but not 5 N more.
TEST(Diagnosis, NormalForcesThatPressTheObjectDownPressItOutOnceTheTableIsGone) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    if (s.time >= 1.5) s.parts[0].normal_W = Eigen::Vector3f(0.0f, 0.0f, -5.0f);
  });
  story.Expect(FailureCause::kPressedOut, "", "left 6.00 N to friction, which could bear 4.80 N");
  story.ForEach([](auto& s) { s.is_on_table = true; });
  story.Expect(FailureCause::kTurned);
}

TEST(Diagnosis, APushWhileTheHandTouchesComesBeforeAllElse) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    if (s.time > 2.15 && s.time < 2.18) s.push = 3.0;
    s.parts[2].is_at_limit = true;
  });
  story.Expect(FailureCause::kPush);
  EXPECT_NEAR(story.Find().time, 2.16, 0.011);
  Story after(2.2);
  after.ForEach([](auto& s) {
    if (s.time > 2.4) s.parts.assign(4, MakePart(0.0));
    if (s.time > 2.5 && s.time < 2.55) s.push = 3.0;
  });
  EXPECT_NE(after.Find().cause, FailureCause::kPush);
}

TEST(Diagnosis, ADigitThatNeverTouchedIsNamed) {
  Story story(2.2);
  story.result.contacts[2].time = kUnset;
  story.result.touches[2].smallest_gap = 0.0034;
  story.ForEach([](auto& s) { s.parts[2] = MakePart(0.0); });
  story.Expect(FailureCause::kNoTouch, "MF", "3.4 mm");
}

TEST(Diagnosis, ADigitWhoseCommandWasBehindIsLate) {
  Story story(2.2);
  story.result.contacts[1].time = 0.9;  // the others: 0.5
  story.ForEach([](auto& s) {
    if (s.time < 1.9) s.parts[1] = MakePart(0.0);
    if (s.time < 1.9) s.parts[1].closing = 0.4f;
    if (s.time > 1.6) s.shift = 0.012;
  });
  story.Expect(FailureCause::kLateDigit, "FF", "400 ms");
}

TEST(Diagnosis, OneSlipperyDigitIsNamedThoughAnotherGivesWayFirst) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    if (s.time >= 1.5) s.parts[2].friction = 0.2f;
  });
  story.Expect(FailureCause::kLowFriction, "MF");
  EXPECT_EQ(story.Find().lost, "TH");
}

TEST(Diagnosis, ADriveAtItsLimitIsToBlameUnlessAllAre) {
  Story story(2.2);
  story.ForEach([](auto& s) { s.parts[1].is_at_limit = true; });
  story.Expect(FailureCause::kWeakDigit, "FF", "A drive of FF gave all it could");
  story.ForEach([](auto& s) { s.parts[1].limit_joint = "FFJ3"; });
  story.Expect(FailureCause::kWeakDigit, "FF", "The drive of FFJ3 of FF gave all it could");
  story.ForEach([](auto& s) {
    for (PartSample& part : s.parts) part.is_at_limit = true;
  });
  EXPECT_NE(story.Find().cause, FailureCause::kWeakDigit);
}

/** A trial that is over before lift-off: the digits press along x, the thumb from 1.5 s on with
`thumb`, the fingers from then on with 2 N at `angle` from it, 1 N each. */
Story MakeSqueeze(double thumb, double angle, double shift_before = 0.0) {
  Story story(2.2);
  story.result.outcome = Outcome::kPushedAway;
  story.result.phases.pop_back();
  for (LoadSample& sample : story.samples) {
    sample.is_on_table = true;
    sample.shift = sample.time < 1.2 ? 0.0 : sample.time < 1.5 ? shift_before : 0.05;
    const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
    if (sample.time >= 1.5) {
      sample.parts[0].normal_W = Eigen::Vector3f(static_cast<float>(thumb), 0.0f, 0.0f);
      sample.parts[1].normal_W = sample.parts[2].normal_W = Eigen::Vector3f(x, y, 0.0f);
    } else if (sample.time >= 1.1) {
      sample.parts[1].force = 0.5f;  // of FF, whoever touches first
    }
  }
  return story;
}

// By which side of 5 mm it has moved before both sides press, and whether it moves at all: too
// heavy, it stays where it is while the hand leaves.
TEST(Diagnosis, AnObjectIsPushedByADigitOrSqueezedOutByTwo) {
  MakeSqueeze(2.0, kPi, 0.0049)
      .Expect(FailureCause::kSqueezedOut, "", "TH with 4.00 N and FF with 2.00 N");
  Story pushed = MakeSqueeze(2.0, kPi, 0.0051);
  pushed.Expect(FailureCause::kPushedByDigit, "FF");
  EXPECT_NEAR(pushed.Find().time, 1.2, 0.011);
  Story story = MakeSqueeze(2.0, kPi);
  story.ForEach([](auto& s) { s.shift *= 0.098; });
  story.Expect(FailureCause::kNotIdentified, "", "the object moved by 4.9 mm at most");
  story.ForEach([](auto& s) { s.shift *= 1.1; });
  story.Expect(FailureCause::kSqueezedOut);
}

TEST(Diagnosis, PartsOpposeEachOtherFrom110DegreesAnd50MillinewtonsOn) {
  EXPECT_EQ(MakeSqueeze(2.0, RadFromDeg(111.0)).Find().cause, FailureCause::kSqueezedOut);
  EXPECT_EQ(MakeSqueeze(2.0, RadFromDeg(109.0)).Find().cause, FailureCause::kPushedByDigit);
  EXPECT_EQ(MakeSqueeze(0.051, kPi).Find().cause, FailureCause::kSqueezedOut);
  EXPECT_EQ(MakeSqueeze(0.049, kPi).Find().cause, FailureCause::kPushedByDigit);
}

TEST(Diagnosis, PartsThatOpposeEachOtherForLessThan20MsDoNotSqueeze) {
  Story story = MakeSqueeze(2.0, kPi);
  for (size_t at = 0; at < story.samples.size(); ++at) {
    if (at % 2 == 0) story.samples[at].parts[0].normal_W.setZero();
    story.samples[at].shift = 0.0;
  }
  EXPECT_EQ(story.Find().cause, FailureCause::kNotIdentified);
}

}  // namespace
}  // namespace graspbench
