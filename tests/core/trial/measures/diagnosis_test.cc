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
}

TEST(Diagnosis, ASlipThatEndsIsNoLoss) {
  Story story(2.6);
  for (LoadSample& sample : story.samples) {
    if (sample.time > 2.1 && sample.time < 2.3) sample.parts[1].is_sliding = true;
  }
  EXPECT_EQ(story.Find().lost, "TH");
  EXPECT_NEAR(story.Find().time, 2.6, 0.011);
}

TEST(Diagnosis, FrictionThatCannotBearTheWeightIsAWeakGrip) {
  const Diagnosis weak = Story(2.2, 0.3).Find();  // 0.6 (0.6 + 0.3 + 0.3) N = 0.72 N of 1 N
  EXPECT_EQ(weak.cause, FailureCause::kWeakGrip);
  EXPECT_NEAR(weak.bearable, 0.72, 1e-6);
  EXPECT_EQ(Story(2.2, 2.0).Find().cause, FailureCause::kTurned);
}

// 0.6 (4 + 2 + 2) N = 4.8 N bears the weight of 1 N, but not 5 N more.
TEST(Diagnosis, NormalForcesThatPressTheObjectDownPressItOutOnceTheTableIsGone) {
  Story story(2.2);
  for (LoadSample& sample : story.samples) {
    if (sample.time >= 1.5) sample.parts[0].normal_W = Eigen::Vector3f(0.0f, 0.0f, -5.0f);
  }
  EXPECT_EQ(story.Find().cause, FailureCause::kPressedOut);
  EXPECT_NE(story.Find().text.find("left 6.00 N to friction, which could bear 4.80 N"),
            std::string::npos)
      << story.Find().text;
  for (LoadSample& sample : story.samples) sample.is_on_table = true;
  EXPECT_EQ(story.Find().cause, FailureCause::kTurned);
}

TEST(Diagnosis, APushComesBeforeAllElse) {
  Story story(2.2);
  for (LoadSample& sample : story.samples) {
    if (sample.time > 2.15 && sample.time < 2.18) sample.push = 3.0;
    sample.parts[2].is_at_limit = true;
  }
  const Diagnosis found = story.Find();
  EXPECT_EQ(found.cause, FailureCause::kPush);
  EXPECT_NEAR(found.time, 2.16, 0.011);
}

TEST(Diagnosis, APushAfterTheHandLetGoIsNotTheCause) {
  Story story(2.2);
  for (LoadSample& sample : story.samples) {
    if (sample.time > 2.4) sample.parts.assign(4, MakePart(0.0));
    if (sample.time > 2.5 && sample.time < 2.55) sample.push = 3.0;
  }
  EXPECT_NE(story.Find().cause, FailureCause::kPush);
}

TEST(Diagnosis, ADigitThatNeverTouchedIsNamed) {
  Story story(2.2);
  story.result.contacts[2].time = kUnset;
  story.result.touches[2].smallest_gap = 0.0034;
  for (LoadSample& sample : story.samples) sample.parts[2] = MakePart(0.0);
  const Diagnosis found = story.Find();
  EXPECT_EQ(found.cause, FailureCause::kNoTouch);
  EXPECT_EQ(found.digit, "MF");
  EXPECT_NE(found.text.find("3.4 mm"), std::string::npos) << found.text;
}

TEST(Diagnosis, ADigitWhoseCommandWasBehindIsLate) {
  Story story(2.2);
  story.result.contacts[1].time = 0.9;  // the others: 0.5
  for (LoadSample& sample : story.samples) {
    if (sample.time < 1.9) sample.parts[1] = MakePart(0.0);
    if (sample.time < 1.9) sample.parts[1].closing = 0.4f;
    if (sample.time > 1.6) sample.shift = 0.012;
  }
  const Diagnosis found = story.Find();
  EXPECT_EQ(found.cause, FailureCause::kLateDigit);
  EXPECT_EQ(found.digit, "FF");
  EXPECT_NE(found.text.find("400 ms"), std::string::npos) << found.text;
}

TEST(Diagnosis, OneSlipperyDigitIsNamedThoughAnotherGivesWayFirst) {
  Story story(2.2);
  for (LoadSample& sample : story.samples) {
    if (sample.time >= 1.5) sample.parts[2].friction = 0.2f;
  }
  const Diagnosis found = story.Find();
  EXPECT_EQ(found.cause, FailureCause::kLowFriction);
  EXPECT_EQ(found.digit, "MF");
  EXPECT_EQ(found.lost, "TH");
}

TEST(Diagnosis, ADriveAtItsLimitIsToBlameUnlessAllAre) {
  Story story(2.2);
  for (LoadSample& sample : story.samples) sample.parts[1].is_at_limit = true;
  EXPECT_EQ(story.Find().cause, FailureCause::kWeakDigit);
  EXPECT_EQ(story.Find().digit, "FF");
  EXPECT_NE(story.Find().text.find("A drive of FF gave all it could"), std::string::npos);
  for (LoadSample& sample : story.samples) sample.parts[1].limit_joint = "FFJ3";
  EXPECT_NE(story.Find().text.find("The drive of FFJ3 of FF gave all it could"), std::string::npos)
      << story.Find().text;
  for (LoadSample& sample : story.samples) {
    for (PartSample& part : sample.parts) part.is_at_limit = true;
  }
  EXPECT_NE(story.Find().cause, FailureCause::kWeakDigit);
}

TEST(Diagnosis, AWeakGripIsNotSaidWhileTheTableBearsTheObject) {
  Story story(2.2, 0.3);
  for (LoadSample& sample : story.samples) sample.is_on_table = sample.time < 2.1;
  EXPECT_EQ(story.Find().cause, FailureCause::kWeakGrip);
  for (LoadSample& sample : story.samples) sample.is_on_table = true;
  EXPECT_EQ(story.Find().cause, FailureCause::kNotIdentified);
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

TEST(Diagnosis, AnObjectThatBothSidesPressBeforeItMovesIsSqueezedOut) {
  const Diagnosis found = MakeSqueeze(2.0, kPi, 0.0049).Find();
  EXPECT_EQ(found.cause, FailureCause::kSqueezedOut);
  EXPECT_EQ(found.digit, "");
  EXPECT_NE(found.text.find("TH with 4.00 N and FF with 2.00 N"), std::string::npos) << found.text;
  EXPECT_NE(found.text.find("from 1.500 s on"), std::string::npos) << found.text;
}

// Too heavy, it stays where it is while the hand leaves.
TEST(Diagnosis, AnObjectThatDoesNotMoveIsNotSqueezedOut) {
  Story story = MakeSqueeze(2.0, kPi);
  for (LoadSample& sample : story.samples) sample.shift *= 0.098;  // 4.9 mm
  EXPECT_EQ(story.Find().cause, FailureCause::kNotIdentified);
  EXPECT_NE(story.Find().text.find("the object moved by 4.9 mm at most"), std::string::npos)
      << story.Find().text;
  for (LoadSample& sample : story.samples) sample.shift *= 1.1;
  EXPECT_EQ(story.Find().cause, FailureCause::kSqueezedOut);
}

TEST(Diagnosis, AnObjectThatMovesBeforeBothSidesPressIsPushed) {
  const Diagnosis found = MakeSqueeze(2.0, kPi, 0.0051).Find();
  EXPECT_EQ(found.cause, FailureCause::kPushedByDigit);
  EXPECT_EQ(found.digit, "FF");
  EXPECT_NEAR(found.time, 1.2, 0.011);
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

TEST(Diagnosis, SurvivesItsRecord) {
  const Diagnosis found = Story(2.2).Find();
  Diagnosis back;
  ReadRecord(RecordToJson(found), back);
  EXPECT_EQ(RecordToJson(back).dump(), RecordToJson(found).dump());
}

}  // namespace
}  // namespace graspbench
