#include "core/rehearse/rehearse_grasp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "tests/core/rehearse/made_objects.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

class RehearseGraspTest : public testing::Test {
 protected:
  RehearseGraspTest()
      : hand_(LoadHand("tum")),
        bar_(MakeTurnedBar(kBar, RadFromDeg(35.0))),
        maker_(hand_, LoadStandardGrasps(hand_), bar_) {}

  /** Where the thumb stands to the others, seen from above, modulo half a turn. */
  double CalcOpposition(const Grasp& grasp) const {
    const auto X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp, 0.5));
    const Digit& thumb = hand_.digits[static_cast<size_t>(FindOpposingDigit(hand_, grasp))];
    Vector3d apart = Vector3d::Zero();
    for (const Digit& digit : hand_.digits) {
      const bool grasps = std::count(grasp.digits.begin(), grasp.digits.end(), digit.id) > 0;
      if (!grasps || digit.id == thumb.id) continue;
      apart += X_HL[digit.distal_link] * digit.p_LPad - X_HL[thumb.distal_link] * thumb.p_LPad;
    }
    const Vector3d apart_W = grasp.placement->X_WH.linear() * apart;
    return std::remainder(std::atan2(apart_W.y(), apart_W.x()), kPi);
  }

  const Hand hand_;
  const GraspObject bar_;
  const CandidateMaker maker_;
};

RehearsalAnswer Hold(bool holds) {
  return holds ? RehearsalAnswer{Outcome::kSuccess, ""}
               : RehearsalAnswer{Outcome::kPushedAway, "was pushed away"};
}

TEST_F(RehearseGraspTest, TheFirstThatHoldsEveryDrawIsChosen) {
  int num_asked = 0;
  const Rehearsal rehearsal =
      RehearseGrasp(maker_, {40, 4}, [&](const Grasp& grasp, const RehearsalQuestion& question) {
        EXPECT_EQ(question.grip_share, 1.0);
        ++num_asked;
        return Hold(grasp.id == "g2" || question.draw < 2);
      });
  EXPECT_EQ(rehearsal.choice().candidate.standard, "g2");
  EXPECT_TRUE(rehearsal.is_robust());
  EXPECT_EQ(rehearsal.chosen, static_cast<int>(rehearsal.tried.size()) - 1);
  // Three trials of each that fails in the third draw; the one that holds proves itself on twelve.
  EXPECT_EQ(num_asked, 3 * rehearsal.chosen + 12);
  EXPECT_EQ(rehearsal.num_trials, num_asked);
  for (int i = 0; i < rehearsal.chosen; ++i) {
    EXPECT_EQ(rehearsal.tried[static_cast<size_t>(i)].FindRun(), 2);
    EXPECT_EQ(rehearsal.tried[static_cast<size_t>(i)].reason, "was pushed away");
  }
}

// The last of the rule holds 11 of 12; the others hold the first five and lose the next two.
TEST_F(RehearseGraspTest, WhatHoldsTheFirstDrawsByLuckIsNotChosen) {
  const std::string last = maker_.ListByRule().back().standard;
  const auto run = [&](const Grasp& grasp, const RehearsalQuestion& question) {
    return Hold(grasp.id == last ? question.draw != 9 : question.draw < 5 || question.draw > 6);
  };
  const Rehearsal rehearsal = RehearseGrasp(maker_, {40, 4}, run);
  EXPECT_EQ(rehearsal.choice().candidate.standard, last);
  EXPECT_EQ(rehearsal.choice().FormatHeld(), "11 of 12");
  EXPECT_EQ(rehearsal.choice().FormatInterval(), "65 to 99 %");  // 64.6 to 98.5
  EXPECT_EQ(rehearsal.num_trials, 7 * rehearsal.chosen + 12);
  EXPECT_GT(rehearsal.chosen, 0);
  // Of those that fail, too, twelve are compared: without the last one the others hold 10.
  const Rehearsal lucky =
      RehearseGrasp(maker_, {3, 4}, [&](const Grasp&, const RehearsalQuestion& question) {
        return Hold(question.draw < 5 || question.draw > 6);
      });
  EXPECT_EQ(lucky.choice().FormatHeld(), "10 of 12");
  // As many draws as prove a choice, or more: each of them must be held.
  const Rehearsal strict = RehearseGrasp(maker_, {40, 12}, run);
  EXPECT_FALSE(strict.is_robust());
}

// Planted: only a hand that closes across the bar holds it, within 8 degrees.
TEST_F(RehearseGraspTest, TheSingleRobustYawIsFound) {
  const double wanted = RadFromDeg(35.0) + 0.5 * kPi;
  const RunRehearsal run = [&](const Grasp& grasp, const RehearsalQuestion&) {
    const double off = std::remainder(CalcOpposition(grasp) - wanted, kPi);
    return Hold(std::abs(off) < RadFromDeg(8.0));
  };
  const Rehearsal by_rule = RehearseGrasp(maker_, {5, 4}, run);
  EXPECT_FALSE(by_rule.is_robust());
  EXPECT_EQ(by_rule.choice().CountHeld(), 0);
  const Rehearsal rehearsal = RehearseGrasp(maker_, {40, 4}, run);
  EXPECT_TRUE(rehearsal.is_robust());
  // By the object's own axes, not by luck among variations.
  const double yaw = rehearsal.choice().candidate.place.yaw;
  EXPECT_NEAR(std::remainder(yaw - wanted, 0.5 * kPi), 0.0, 1e-6);
  EXPECT_NEAR(
      std::remainder(CalcOpposition(maker_.Make(rehearsal.choice().candidate)) - wanted, kPi), 0.0,
      RadFromDeg(8.0));
}

TEST_F(RehearseGraspTest, WhatNothingHoldsIsSaidWithTheBestShare) {
  const Rehearsal none = RehearseGrasp(
      maker_, {20, 4}, [](const Grasp&, const RehearsalQuestion&) { return Hold(false); });
  EXPECT_FALSE(none.is_robust());
  EXPECT_EQ(none.choice().CountHeld(), 0);
  EXPECT_EQ(none.choice().outcomes.size(), 4u);
  EXPECT_EQ(none.tried.size(), 20u);
  // 20 first draws, and the three others of three candidates.
  EXPECT_EQ(none.num_trials, 29);

  // Three of four at best, g3 with the longest run.
  const Rehearsal some =
      RehearseGrasp(maker_, {20, 4}, [](const Grasp& grasp, const RehearsalQuestion& question) {
        return Hold(question.draw != (grasp.id == "g3" ? 2 : 1));
      });
  EXPECT_EQ(some.choice().candidate.standard, "g3");
  EXPECT_EQ(some.choice().FindRun(), 2);
  EXPECT_EQ(some.choice().CountHeld(), 3);
  EXPECT_FALSE(some.is_robust());
}

// A long run is luck where another candidate holds more of all draws.
TEST_F(RehearseGraspTest, OfThoseThatNeverHoldAllTheMostHeldIsChosen) {
  const Rehearsal rehearsal =
      RehearseGrasp(maker_, {5, 8}, [](const Grasp& grasp, const RehearsalQuestion& question) {
        return Hold(grasp.id == "g2"   ? question.draw < 3
                    : grasp.id == "g4" ? question.draw != 1
                                       : question.draw > 5);
      });
  EXPECT_EQ(rehearsal.choice().candidate.standard, "g4");
  EXPECT_EQ(rehearsal.choice().CountHeld(), 7);
}

TEST_F(RehearseGraspTest, TheLowestGripThresholdDecidesBetweenEqualRuns) {
  const Rehearsal rehearsal =
      RehearseGrasp(maker_, {5, 4}, [](const Grasp& grasp, const RehearsalQuestion& question) {
        const double least = grasp.id == "g4" ? 0.2 : 0.4;
        return Hold(question.draw < 2 && question.grip_share >= least);
      });
  EXPECT_EQ(rehearsal.choice().candidate.standard, "g4");
  EXPECT_EQ(rehearsal.choice().grip_threshold, 0.25);
  for (const RehearsedCandidate& tried : rehearsal.tried) {
    EXPECT_EQ(tried.grip_threshold, tried.candidate.standard == "g4" ? 0.25 : 0.5);
  }
}

// A world in which every trial is a fair coin, whatever the candidate. The chosen one has held most
// draws of its rehearsal; on other draws it holds half. Draws of another stream see that, and those
// of the rehearsal itself do not.
TEST_F(RehearseGraspTest, EvaluatedOnItsOwnDrawsTheChoiceLooksBetterThanItIs) {
  const auto holds = [](const Grasp& grasp, const std::string& stream) {
    const Pose& X = grasp.placement->X_WH;
    const std::string what = grasp.id + std::to_string(X.translation().sum() + X.linear().sum()) +
                             std::to_string(grasp.q_pre.sum());
    return RandomStream(what, stream).NextUnit() < 0.5;
  };
  int num_rehearsed = 0, num_fresh = 0, num = 0;
  for (int object = 0; object < 12; ++object) {
    const auto name = [&](const char* of, int draw) {
      return of + std::to_string(object) + "/" + std::to_string(draw);
    };
    const Rehearsal rehearsal =
        RehearseGrasp(maker_, {40, 4}, [&](const Grasp& grasp, const RehearsalQuestion& question) {
          return Hold(holds(grasp, name("rehearsal", question.draw)));
        });
    const auto num_own = static_cast<int>(rehearsal.choice().outcomes.size());
    const Grasp chosen = maker_.Make(rehearsal.choice().candidate);
    for (int draw = 0; draw < 40; ++draw) {
      num_fresh += holds(chosen, name("session", draw));
      num_rehearsed += holds(chosen, name("rehearsal", draw % num_own));
      ++num;
    }
  }
  ASSERT_GE(num, 200);
  EXPECT_GT(num_rehearsed, 0.65 * num);
  // Three standard deviations of a fair coin.
  EXPECT_NEAR(static_cast<double>(num_fresh) / num, 0.5, 3.0 * 0.5 / std::sqrt(num));
}

TEST_F(RehearseGraspTest, HalfOfTheDrawsHaveAWrongModel) {
  int num_doubtful = 0;
  for (int draw = 0; draw < 8; ++draw) num_doubtful += IsDoubtful(draw);
  EXPECT_EQ(num_doubtful, 4);
  EXPECT_FALSE(IsDoubtful(0));
}

TEST_F(RehearseGraspTest, ARehearsalSurvivesItsRecord) {
  const Rehearsal rehearsal =
      RehearseGrasp(maker_, {40, 3}, [&](const Grasp& grasp, const RehearsalQuestion& question) {
        return Hold(CalcHash64(grasp.id + std::to_string(question.draw)) % 3 == 0);
      });
  Rehearsal read;
  ReadRecord(Json::parse(FormatJson(RecordToJson(rehearsal))), read);
  EXPECT_EQ(FormatJson(RecordToJson(read)), FormatJson(RecordToJson(rehearsal)));
  EXPECT_TRUE(read.choice().candidate == rehearsal.choice().candidate);
}

TEST_F(RehearseGraspTest, ASearchFindsTheTargetThatNoPlacementHas) {
  const auto standard = LoadStandardGrasps(hand_);
  const Digit& thumb = hand_.digits[static_cast<size_t>(FindOpposingDigit(hand_, standard[0]))];
  const int joint = FindDrivenJoints(hand_, thumb).back();
  const auto run = [&](const Grasp& grasp, const RehearsalQuestion&) {
    const auto same = std::find_if(standard.begin(), standard.end(),
                                   [&](const Grasp& one) { return one.id == grasp.id; });
    return Hold(std::abs(grasp.q_target[joint] - same->q_target[joint]) > RadFromDeg(8.0));
  };
  EXPECT_EQ(RehearseGrasp(maker_, {40, 4}, run).choice().CountHeld(), 0);
  const Rehearsal searched = RehearseGrasp(maker_, {40, 4, 60}, run);
  EXPECT_TRUE(searched.is_robust());
  EXPECT_FALSE(searched.choice().candidate.posture.empty());
  EXPECT_EQ(searched.choice().outcomes.size(), 16u);
}

TEST_F(RehearseGraspTest, ASearchDoesNotChooseAPostureByLuck) {
  int num_lucky = 0;
  const auto run = [&](const Grasp& grasp, const RehearsalQuestion& question) {
    if (grasp.q_target.isApprox(maker_.Make({grasp.id, Approach::kAutomatic, {}, 0.0}).q_target,
                                1e-12)) {
      return Hold(question.draw != 1);
    }
    const Json name = {grasp.q_target.sum(), question.draw};
    return Hold(CalcHash64(FormatJson(name)) % 2 == 0);
  };
  const Rehearsal searched = RehearseGrasp(maker_, {40, 4, 200}, run);
  for (const RehearsedCandidate& one : searched.tried) {
    num_lucky += !one.candidate.posture.empty() && one.FindRun() >= 4;
  }
  EXPECT_GT(num_lucky, 3);
  EXPECT_TRUE(searched.choice().candidate.posture.empty());
  EXPECT_EQ(searched.choice().CountHeld(), 15);
}

}  // namespace
}  // namespace graspbench
