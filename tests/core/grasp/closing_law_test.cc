#include "core/grasp/closing_law.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

constexpr double kClosingStep = 0.002, kTime = 0.8;

double CalcAfter(const ClosingSchedule& schedule, double time) {
  ClosingLaw law(schedule);
  for (int i = 0; i < std::lround(time / kClosingStep); ++i) law.Advance(kClosingStep, kTime, 1.0);
  return law.closing();
}

TEST(ClosingLaw, IsTheClippedLine) {
  for (const double delay : {0.0, 0.05, 0.3}) {
    for (const double speed : {0.5, 1.0, 2.0}) {
      for (const double time : {0.0, 0.04, 0.2, 0.5, 3.0}) {
        const double line = std::clamp((time - delay) * speed / kTime, 0.0, 1.0);
        EXPECT_NEAR(CalcAfter({delay, speed}, time), line, 1e-12) << delay << " " << speed;
      }
    }
  }
}

// The thesis's common s was a sum of steps; one digit's is the same number.
TEST(ClosingLaw, WithoutAScheduleItIsTheCommonSumToTheBit) {
  ClosingLaw law;
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    sum = std::min(1.0, sum + kClosingStep / kTime);
    law.Advance(kClosingStep, kTime, 1.0);
    ASSERT_EQ(law.closing(), sum);
  }
}

TEST(ClosingLaw, ASlowerShareIsSlowerByThat) {
  ClosingLaw law;
  for (int i = 0; i < 100; ++i) law.Advance(kClosingStep, kTime, 0.25);
  EXPECT_NEAR(law.closing(), 0.25 * 100 * kClosingStep / kTime, 1e-12);
}

TEST(ClosingLaw, NeverLeavesTheWayBetweenThePostures) {
  ClosingLaw law;
  law.MoveTo(-0.2);
  EXPECT_EQ(law.closing(), 0.0);
  law.MoveTo(1.3);
  EXPECT_EQ(law.closing(), 1.0);
}

TEST(ClosingLaw, TimeToTheTarget) {
  EXPECT_DOUBLE_EQ(CalcClosingTime({0.1, 0.5}, kTime), 1.7);
  EXPECT_LT(CalcAfter({0.1, 0.5}, 1.69), 1.0);
  EXPECT_NEAR(CalcAfter({0.1, 0.5}, 1.702), 1.0, 1e-12);
}

std::string MakeFile(const Hand& hand, const std::string& closing) {
  Grasp grasp = LoadStandardGrasps(hand).front();
  grasp.id = "mine";
  return FormatGraspFile(hand, grasp, "g1") + closing;
}
std::string FindProblem(const Hand& hand, const std::string& closing) {
  try {
    ParseGraspFile(MakeFile(hand, closing), "mine.yaml", {&hand});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ClosingYamlTest, IsReadAndWritten) {
  const Hand hand = LoadHand("tum");
  const Grasp grasp =
      ParseGraspFile(MakeFile(hand, "closing: {FF: {delay_s: 0.05, speed: 1.5}, TH: {speed: 1}}\n"),
                     "mine.yaml", {&hand})
          .grasp;
  ASSERT_EQ(grasp.closing.size(), 1u);  // a schedule that changes nothing is none
  EXPECT_TRUE(grasp.closing.at("FF") == (ClosingSchedule{0.05, 1.5}));
  const std::string text = FormatGraspFile(hand, grasp, "g1");
  const Grasp again = ParseGraspFile(text, "again.yaml", {&hand}).grasp;
  EXPECT_TRUE(again.closing == grasp.closing);
  EXPECT_EQ(FormatGraspFile(hand, again, "g1"), text);
}

TEST(ClosingYamlTest, NoDigitMayStayOpenForGood) {
  const Hand hand = LoadHand("tum");
  EXPECT_NE(FindProblem(hand, "closing: {FF: {speed: 0}}\n").find("out of range"),
            std::string::npos);
  EXPECT_NE(FindProblem(hand, "closing: {FF: {delay_s: 600}}\n").find("out of range"),
            std::string::npos);
  EXPECT_NE(FindProblem(hand, "closing: {FF: {delay_s: -1}}\n").find("out of range"),
            std::string::npos);
  EXPECT_NE(FindProblem(hand, "closing: {RF: {speed: 1}}\n").find("RF"), std::string::npos);
  EXPECT_NE(FindProblem(hand, "closing: {FF: {delay_ms: 5}}\n").find("delay_ms"),
            std::string::npos);
  EXPECT_EQ(FindProblem(hand, ""), "");
}

}  // namespace
}  // namespace graspbench
