#include "human_study/events/hold.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "human_study/events/hand_opening.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/study/synthetic/synthetic_study.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A hand that goes out 0.4 m (0.2 to 1 s), waits there open (to 2 s), closes (to 2.4 s), holds (to
3 s), opens (to 3.4 s) and goes back (to 4.2 s); then it waits (to 6 s). */
struct Pantomime {
  std::vector<double> times = MakeTimes(0.0, 6.0, 100.0);
  ReachTrial trial;
  Trajectory middle;
  ScalarCurve opening;

  Pantomime() {
    const auto place = [](double t) {
      return Vector3d(0.4 * (Ease(t, 0.2, 1.0) - Ease(t, 3.4, 4.2)), 0, 0);
    };
    const auto width = [](double t) {
      return 0.02 + 0.08 * (Ease(t, 0.2, 0.9) - Ease(t, 3.4, 4.2)) - 0.05 * Ease(t, 2.0, 2.4) +
             0.05 * Ease(t, 3.0, 3.4);
    };
    trial.times = times;
    for (const double side : {-0.5, 0.5}) {
      DigitTrack digit;
      digit.digit = side < 0 ? "TH" : "FF";
      digit.is_thumb = side < 0;
      digit.tip = SamplePath(times, [&](double t) {
        return Vector3d(place(t) + side * width(t) * Vector3d::UnitY());
      });
      trial.digits.push_back(digit);
    }
    middle = SamplePath(times, place);
    opening = SampleCurve(times, width);
  }

  Hold Find(const std::string& rule = "multiplied") const {
    HoldOptions options;
    options.rule = rule;
    FilteredTrial filtered(trial);
    return FindHold(filtered, middle, opening, options, 6.0);
  }
};

TEST(Hold, AClosedHandCountsMoreThanALongerPauseOfTheOpenHand) {
  const Pantomime pantomime;
  const Hold hold = pantomime.Find();
  ASSERT_TRUE(hold.IsFound()) << hold.missing;
  EXPECT_NEAR(hold.time, 2.7, 0.02);  // the middle, as everything is symmetrical about it
  EXPECT_GT(hold.begin, 2.2);
  EXPECT_LT(hold.begin, 2.45);
  EXPECT_GT(hold.end, 2.95);
  EXPECT_LT(hold.end, 3.2);
  // Which a rule of time alone cannot tell.
  EXPECT_NEAR(pantomime.Find("longest_rest").time, 1.5, 0.1);
}

TEST(Hold, TheLongRestAtTheStartIsNone) {
  Pantomime pantomime;
  HideSamples(pantomime.trial.digits[0].tip, 0.9, 3.5);
  HideSamples(pantomime.trial.digits[1].tip, 0.9, 3.5);
  for (const HoldRule& rule : HoldRuleList()) {
    const Hold hold = pantomime.Find(rule.id);
    EXPECT_FALSE(hold.IsFound());
    EXPECT_EQ(hold.missing,
              "near the object all tips are hidden for a while and never rest together before or "
              "after it");
  }
}

TEST(Hold, OneHiddenTipLeavesTheJudgementToTheOthers) {
  Pantomime pantomime;
  HideSamples(pantomime.trial.digits[0].tip, 2.4, 3.1);
  for (Eigen::Index i = 0; i < pantomime.opening.values.size(); ++i) {
    if (!pantomime.trial.digits[0].tip.IsValid(static_cast<size_t>(i))) {
      pantomime.opening.values[i] = std::nan("");
    }
  }
  const Hold hold = pantomime.Find();
  ASSERT_TRUE(hold.IsFound());
  EXPECT_NEAR(hold.time, 2.7, 0.05);
}

TEST(Hold, AnObjectThatWasRecordedTellsTheHoldFromWhereTheHandGoesAfterwards) {
  Pantomime pantomime;
  // After the hold the hand goes on, past the object, and waits there closed.
  const auto place = [](double t) {
    return Vector3d(0.4 * Ease(t, 0.2, 1.0) + 0.4 * Ease(t, 3.4, 4.2), 0, 0);
  };
  pantomime.middle = SamplePath(pantomime.times, place);
  for (DigitTrack& digit : pantomime.trial.digits) {
    for (size_t i = 0; i < pantomime.times.size(); ++i) {
      digit.tip.p(0, static_cast<Eigen::Index>(i)) = place(pantomime.times[i]).x();
    }
  }
  EXPECT_GT(pantomime.Find().time, 4.0);
  pantomime.trial.object.X_LO.assign(pantomime.times.size(), MakePose(Vector3d(0.4, 0, 0)));
  pantomime.trial.object.states.assign(pantomime.times.size(), SampleState::kMeasured);
  EXPECT_NEAR(pantomime.Find().time, 2.7, 0.02);
}

TEST(Hold, AHandThatNeverRestsHasNone) {
  Pantomime pantomime;
  for (DigitTrack& digit : pantomime.trial.digits) {
    for (size_t i = 0; i < pantomime.times.size(); ++i) {
      digit.tip.p(2, static_cast<Eigen::Index>(i)) += 0.06 * pantomime.times[i];  // 60 mm/s
    }
  }
  EXPECT_EQ(pantomime.Find().missing, "near the object the tips never rest together");
}

TEST(Hold, LiesBetweenTheLastContactAndTheReleaseOfMadeUpReaches) {
  for (const bool rests : {true, false}) {
    for (const bool has_object : {true, false}) {
      SyntheticOptions options;
      options.seed = "holds";
      options.lifts = false;
      options.rests = rests;
      options.rate = 100.0;
      options.dropouts_per_second = 0.3;
      for (const SyntheticTrial& trial : MakeSyntheticStudy(options)) {
        ReachTrial reach = MakeReachTrial(trial);
        if (!has_object) reach.object = ObjectTrack();
        for (const HoldRule& rule : HoldRuleList()) {
          AnalysisOptions analysis;
          analysis.hold.rule = rule.id;
          const Hold hold = AnalyseTrial(reach, analysis).hold;
          ASSERT_TRUE(hold.IsFound()) << rule.id << ": " << hold.missing;
          EXPECT_GT(hold.time,
                    *std::max_element(trial.truth.contacts.begin(), trial.truth.contacts.end()));
          EXPECT_LT(hold.time, trial.truth.release);
        }
      }
    }
  }
}

// A cylinder of 60 by 100 mm tilts about its edge by 4 degrees and is lifted after that. Its middle
// rises from 1.0 s on, its lowest point from 1.3 s on, which is what the shape tells.
TEST(ObjectEvents, AnObjectThatTiltsOnItsEdgeLeavesWithItsLowestPoint) {
  constexpr double kRadius = 0.03, kHeight = 0.1, kTilts = 1.0, kLeaves = 1.3;
  ReachTrial trial;
  trial.times = MakeTimes(0.0, 3.0, 200.0);
  for (const double t : trial.times) {
    const double tilt = RadFromDeg(4.0) * Ease(t, kTilts, kLeaves - 0.05);
    const Eigen::AngleAxisd R(tilt, Vector3d::UnitY());  // the edge at +x stays
    const Vector3d edge(kRadius, 0, -kHeight / 2);
    Pose X = Pose::Identity();
    X.linear() = R.toRotationMatrix();
    X.translation() = edge - R * edge + 0.1 * Ease(t, kLeaves, kLeaves + 0.8) * Vector3d::UnitZ();
    trial.object.X_LO.push_back(X);
  }
  trial.object.states.assign(trial.times.size(), SampleState::kMeasured);
  trial.object.turn_lever = 0.04 * Eigen::Matrix3d::Identity();
  const LiftOffOptions options;
  const auto find = [&] {
    return FindObjectEvents(CalcObjectTravel(trial, options), options).lift_off;
  };
  EXPECT_LT(find().time, kLeaves - 0.08) << "without a shape its middle is all that is seen";
  for (const auto& [distance, name] :
       {std::pair(MakeCylinderDistance(kRadius, kHeight), "cylinder"),
        std::pair(MakeBoxDistance({2.0 * kRadius, 2.0 * kRadius, kHeight}), "box")}) {
    trial.object.distance = distance;
    EXPECT_NEAR(find().time, kLeaves, 0.03) << name;
  }
  // A middle of the markers above the object is no middle of the object.
  trial.object.p_OC = {0.0, 0.0, 0.08};
  EXPECT_NEAR(find().time, kLeaves, 0.03);
}

}  // namespace
}  // namespace graspbench
