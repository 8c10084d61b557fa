#include "core/trial/measures/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/measures/load_recorder.h"
#include "core/trial/protocols/protocol.h"
#include "core/trial/trial_result.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

constexpr double kClosure = 1.0, kLiftOff = 2.0, kEnd = 3.0;  // since the start of placing [s]

/** A trial that is told sample by sample: the thumb presses along x, two fingers against it, from
1.5 s until `lost_at`; the object weighs 1 N. */
struct Story {
  TrialResult result;
  std::vector<LoadSample> samples;

  explicit Story(double lost_at, double thumb = 2.0, double angle = kPi) {
    result.outcome = Outcome::kSlippedInLiftOff;
    result.weight = 1.0;
    result.contacts = {{"TH", true, 0.5}, {"FF", false, 0.51}, {"MF", false, 0.5}};
    result.touches.resize(3);
    result.phases = {{NameOf(Phase::kClosure), 0.0},
                     {NameOf(Phase::kLiftOff), kLiftOff - kClosure}};
    const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
    for (int i = 1; i < std::lround(100.0 * kEnd); ++i) {
      LoadSample sample;
      sample.time = 0.01 * i;
      sample.parts.resize(4);
      if (sample.time > 1.495 && sample.time < lost_at - 0.005) {
        Press(sample.parts[0], Eigen::Vector3f(static_cast<float>(thumb), 0.0f, 0.0f));
        Press(sample.parts[1], Eigen::Vector3f(x, y, 0.0f));
        Press(sample.parts[2], Eigen::Vector3f(x, y, 0.0f));
      }
      samples.push_back(sample);
    }
  }
  static void Press(PartSample& part, const Eigen::Vector3f& force_W) {
    part.normal_W = force_W;
    part.force = force_W.norm();
  }
  Diagnosis Find() const { return *FindDiagnosis(result, samples, kClosure); }
  template <class Change>
  void ForEach(Change&& change) {
    for (LoadSample& sample : samples) change(sample);
  }
  void Expect(Mechanism mechanism, const std::string& part = "") const {
    const Diagnosis found = Find();
    EXPECT_STREQ(NameOf(found.mechanism), NameOf(mechanism));
    EXPECT_EQ(found.part, part);
  }
};

TEST(Diagnosis, ASuccessAndAnUnreachableObjectHaveNone) {
  Story story(2.2);
  for (const Outcome outcome : {Outcome::kSuccess, Outcome::kUnreachable, Outcome::kNotSeen}) {
    story.result.outcome = outcome;
    EXPECT_FALSE(FindDiagnosis(story.result, story.samples, kClosure));
    EXPECT_EQ(DescribeDiagnosis(story.result), "");
  }
}

// 15 samples of the last 150 ms: FF works with 15 x 0.3 mJ = 4.5 mJ, gravity with 15 x 0.2 mJ.
TEST(Diagnosis, TheLargerWorkOfTheLast150MillisecondsDecides) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    s.parts[1].normal_work = 3e-4f;
    s.parts[2].friction_work = -1e-4f;
    s.gravity_work = s.time < 1.9 ? 1.0 : 2e-4;
  });
  story.Expect(Mechanism::kSqueezedOut, "FF");
  EXPECT_NEAR(story.Find().CalcNormalWork(), 16 * 3e-4, 3.1e-4);
  EXPECT_NEAR(story.Find().gravity_work, 16 * 2e-4, 2.1e-4);
  EXPECT_NEAR(story.Find().time, 2.19, 1e-9) << "the last sample in which both sides press";
  EXPECT_EQ(story.Find().phase, "lift-off");
  story.ForEach([](auto& s) { s.gravity_work = 4e-4; });
  story.Expect(Mechanism::kSlid, "MF");
  story.ForEach([](auto& s) {
    const double turned = RadFromDeg(s.time < 2.15 ? 0.0 : 16.0);
    s.R_HO = Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitY()).toRotationMatrix().cast<float>();
  });
  story.Expect(Mechanism::kSagged, "MF");
  EXPECT_NEAR(DegFromRad(story.Find().turn), 16.0, 1e-3);
}

// 1 N through 0.2 mm is 0.2 mJ.
TEST(Diagnosis, WorkBelowThatOfAFallBy200MicrometresNamesNothing) {
  Story story(2.2);
  story.samples[210].gravity_work = 0.19e-3;
  story.Expect(Mechanism::kNotIdentified);
  story.samples[210].gravity_work = 0.21e-3;
  EXPECT_EQ(story.Find().mechanism, Mechanism::kSlid);
}

// It turns about y by 1 degree every 10 ms from 2.1 s on, and hangs from 2.4 s on.
TEST(Diagnosis, OfAnObjectStillInTheHandAllTimeSinceLiftOffCounts) {
  Story story(kEnd + 1.0);
  for (LoadSample& s : story.samples) {
    const double turned = RadFromDeg(100.0 * std::clamp(s.time - 2.1, 0.0, 0.3));
    s.R_HO = Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitY()).toRotationMatrix().cast<float>();
    if (s.time > 2.1 && s.time < 2.4) s.gravity_work = 1e-3;
  }
  const Diagnosis found = story.Find();
  EXPECT_STREQ(NameOf(found.mechanism), "sagged");
  EXPECT_NEAR(DegFromRad(found.turn), 30.0, 0.1);
  EXPECT_NEAR(found.time, 2.1 + 0.15, 0.011) << "15 degrees";
}

TEST(Diagnosis, PartsOpposeEachOtherFrom110DegreesAnd50MillinewtonsFor20Milliseconds) {
  const auto is_opposed = [](const Story& story) {
    return !std::isnan(story.Find().opposed_since);
  };
  EXPECT_TRUE(is_opposed(Story(2.2, 2.0, RadFromDeg(111.0))));
  EXPECT_FALSE(is_opposed(Story(2.2, 2.0, RadFromDeg(109.0))));
  EXPECT_TRUE(is_opposed(Story(2.2, 0.051)));
  EXPECT_FALSE(is_opposed(Story(2.2, 0.049)));
  EXPECT_TRUE(is_opposed(Story(1.53)));
  EXPECT_FALSE(is_opposed(Story(1.52)));
  Story(2.2, 0.049).Expect(Mechanism::kNotReached);
}

TEST(Diagnosis, RunsThatAreInterruptedByLessThan30MillisecondsAreOne) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    const bool is_away = s.time > 1.995 && s.time < 2.025;
    if (is_away) s.parts[0] = {};
  });
  EXPECT_NEAR(story.Find().time, 2.19, 1e-9);
  EXPECT_NEAR(story.Find().opposed_since, 1.5, 1e-9);
}

/** FF presses from 0.95 s on, before closure, TH with less from 0.9 s on; both until 1.5 s, and it
has moved by the shift at 1.2 s. */
void Push(double shift, Story& story) {
  story.ForEach([shift](auto& s) {
    s.shift = s.time < 1.195 ? 0.0 : s.time < 1.5 ? shift : 0.05;
    if (s.time > 0.945 && s.time < 1.5) s.parts[1].force = 0.5f;
    if (s.time > 0.895 && s.time < 1.5) s.parts[0].force = 0.1f;
  });
}

TEST(Diagnosis, AnObjectThatMovesMoreThan5MillimetresBeforeTwoPartsOpposeWasPushed) {
  Story story(1.9);
  Push(0.0051, story);
  story.Expect(Mechanism::kPushed, "FF");
  EXPECT_NEAR(story.Find().time, 0.95, 1e-9) << "its touch";
  EXPECT_EQ(story.Find().phase, "placing");
  story.result.diagnosis = story.Find();
  EXPECT_NE(DescribeDiagnosis(story.result)
                .find("FF touched the object during placing at 0.950 s and pushed it"),
            std::string::npos);
  Push(0.0049, story);
  EXPECT_NE(story.Find().mechanism, Mechanism::kPushed);
  EXPECT_NEAR(story.Find().shift, 0.0049, 1e-9);
}

// Two parts oppose each other from 1.5 s on.
TEST(Diagnosis, APushedObjectThatWasGraspedForHalfASecondIsLostOtherwise) {
  for (const auto& [lost_at, mechanism] :
       {std::pair(1.99, Mechanism::kPushed), std::pair(2.01, Mechanism::kSlid)}) {
    Story story(lost_at);
    Push(0.02, story);
    story.ForEach([](auto& s) { s.gravity_work = 1e-3; });
    EXPECT_STREQ(NameOf(story.Find().mechanism), NameOf(mechanism)) << lost_at;
    EXPECT_NEAR(story.Find().shift, 0.02, 1e-9);
  }
}

// 16 samples of FF's normal force and of MF's friction.
TEST(Diagnosis, WhatFrictionDragsMoreThanNormalForcesPushIsNotSqueezedOut) {
  Story story(2.2);
  const auto drag = [&](float friction_work) {
    story.ForEach([friction_work](auto& s) {
      s.parts[1].normal_work = 1e-3f;
      s.parts[2].friction_work = friction_work;
    });
  };
  drag(0.99e-3f);
  story.Expect(Mechanism::kSqueezedOut, "FF");
  drag(1.01e-3f);
  story.Expect(Mechanism::kNotIdentified);
}

// Gravity does 1 mJ a sample, the friction of FF 1 % less or more.
TEST(Diagnosis, WhatFrictionDragsMoreThanGravityDidNotSlide) {
  Story story(2.2);
  const auto drag = [&](float friction_work) {
    story.ForEach([friction_work](auto& s) {
      s.gravity_work = 1e-3;
      s.parts[1].friction_work = friction_work;
    });
  };
  drag(0.99e-3f);
  EXPECT_EQ(story.Find().mechanism, Mechanism::kSlid);
  drag(1.01e-3f);
  story.Expect(Mechanism::kNotIdentified);
}

// What others do between them without it decides; the words name it.
TEST(Diagnosis, ADigitThatNeverTouchedIsNamedAndWasNotReachedWhereNoneOppose) {
  Story story(2.2, 0.0);
  story.result.contacts[2].time = kUnset;
  story.result.touches[2].smallest_gap = 0.0034;
  story.Expect(Mechanism::kNotReached, "MF");
  story.result.diagnosis = story.Find();
  EXPECT_NE(DescribeDiagnosis(story.result).find("The smallest gap of MF was 3.4 mm."),
            std::string::npos);
  Story held(2.2);
  held.result.contacts[2].time = kUnset;
  held.ForEach([](auto& s) { s.gravity_work = 1e-3; });
  held.result.diagnosis = held.Find();
  EXPECT_EQ(held.result.diagnosis->mechanism, Mechanism::kSlid);
  EXPECT_NE(DescribeDiagnosis(held.result)
                .find("MF did not touch during closure; the others touched within 10 ms."),
            std::string::npos);
}

// Gravity does 1 mJ a sample. What normal forces drive out does so through a drive that yields: FF
// takes half of TH's 2 mJ and gravity's, or less.
TEST(Diagnosis, ADriveAtItsLimitIsNamedWhereTheObjectIsHeavyOrItsDigitGaveWay) {
  Story story(2.2);
  story.ForEach([](auto& s) {
    s.gravity_work = 1e-3;
    s.parts[1].is_at_limit = true;
    s.parts[1].limit_joint = "FFJ3";
  });
  story.Expect(Mechanism::kDriveAtLimit, "FF");
  EXPECT_EQ(story.Find().joint, "FFJ3");
  const auto yield = [&](float work) {
    story.ForEach([work](auto& s) {
      s.gravity_work = 0.0;
      s.parts[0].normal_work = 2e-3f;
      s.parts[1].normal_work = work;
    });
  };
  yield(-1.01e-3f);
  story.Expect(Mechanism::kDriveAtLimit, "FF");
  yield(-0.99e-3f);
  story.Expect(Mechanism::kSqueezedOut, "TH");
  story.ForEach([](auto& s) {
    s.gravity_work = 3e-3;
    for (PartSample& part : s.parts) part.is_at_limit = true;
  });
  EXPECT_EQ(story.Find().mechanism, Mechanism::kSlid) << "all are: nothing sets FF apart";
}

TEST(Diagnosis, AnOverloadedArmIsAtItsLimit) {
  Story story(2.2);
  story.result.outcome = Outcome::kArmOverloaded;
  story.Expect(Mechanism::kArmAtLimit);
}

/** The trial's diagnosis; it must have failed. */
Diagnosis Fail(const TrialSetup& setup) {
  const TrialResult result = RunSetup(setup);
  EXPECT_FALSE(IsSuccess(result.outcome));
  if (!result.diagnosis) ADD_FAILURE() << NameOf(result.outcome) << " " << result.reason;
  ExpectSurvivesItsRecord(result);
  std::cout << NameOf(result.outcome) << ": " << DescribeDiagnosis(result) << "\n";
  return result.diagnosis.value_or(Diagnosis());
}

/** Upright, its two sides 30 degrees from x, its edge at +x. */
std::shared_ptr<const GraspObject> MakeWedge(double mu) {
  const double length = 0.04, half_width = length * std::tan(RadFromDeg(30.0));
  std::vector<Ring> rings;
  for (const double z : {-0.0155, 0.0155}) {
    rings.push_back({{2.0 / 3.0 * length, 0.0, z},
                     {-length / 3.0, half_width, z},
                     {-length / 3.0, -half_width, z}});
  }
  GraspObject object = MakeSolid(MakeLoft(rings), 0.03, mu, mu);
  object.id = "wedge";
  return std::make_shared<const GraspObject>(object);
}

// On sides at 30 degrees to their direction two forces leave 2 N sin 30 towards the wide end, which
// friction mu holds back with 2 mu N cos 30: with mu = 0.02 it goes, with tan 30 = 0.58 < 1 it
// stays.
TEST(DiagnosisOfATrial, ASmoothWedgeBetweenTwoFingersIsSqueezedOut) {
  const Diagnosis found = Fail(MakeSetup("tum", "g2", MakeWedge(0.02)));
  EXPECT_STREQ(NameOf(found.mechanism), "squeezed out");
  EXPECT_GT(found.CalcNormalWork(), 0.0);
  EXPECT_LE(found.CalcFrictionWork(), 0.0) << "friction only brakes";
}

// 0.3 kg at a lever of 60 mm ask for 0.18 N m, some ten times what torsion of two pads gives, while
// friction bears the weight. The bar's end 160 mm away stays on the table as the hand rises by 100.
TEST(DiagnosisOfATrial, AHeavyBarHeldOffCentreSags) {
  GraspObject bar = MakeSolid(MakeRoundedBox({0.2, 0.025, 0.031}, 0.001, 2), 0.3, 1.0, 1.0);
  bar.id = "bar";
  TrialSetup setup = MakeSetup("tum", "g2", std::make_shared<const GraspObject>(bar));
  setup.draw.offset_x = 0.06;
  const Diagnosis found = Fail(setup);
  EXPECT_STREQ(NameOf(found.mechanism), "sagged");
  EXPECT_GT(found.turn, std::asin(0.095 / 0.16)) << "more where the bar slides towards its middle";
  EXPECT_LT(found.turn, 0.5 * kPi);
}

// Two digits with 0.7 N and friction 0.2 bear 0.28 N of 2.9 N.
TEST(DiagnosisOfATrial, TooLittleGripSlides) {
  TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.3, 0.2));
  setup.strategy.grip = "force";
  setup.strategy.touch_speed = 0.25;
  const Diagnosis found = Fail(setup);
  EXPECT_STREQ(NameOf(found.mechanism), "slid");
  EXPECT_EQ(found.phase, NameOf(Phase::kLiftOff));
  EXPECT_GT(found.gravity_work, std::abs(found.CalcNormalWork()));
}

TEST(DiagnosisOfATrial, APushFromOutsideIsNamedWithItsForceAndTime) {
  const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  TrialRunner runner(setup.hand, setup.object);
  const TrialResult result = runner.Run(setup, [&](TrialCourse& course) {
    const double since = course.time() - 3.0;
    course.world().SetExternalLoad({0.0, 0.0, since >= 0.0 && since < 0.1 ? -12.0 : 0.0},
                                   Eigen::Vector3d::Zero());
  });
  ASSERT_TRUE(result.diagnosis) << NameOf(result.outcome);
  EXPECT_STREQ(NameOf(result.diagnosis->mechanism), "outside push");
  EXPECT_NEAR(result.diagnosis->time, 3.0, 0.021);
  EXPECT_NEAR(result.diagnosis->push, 12.0, 2.0);
}

}  // namespace
}  // namespace graspbench
