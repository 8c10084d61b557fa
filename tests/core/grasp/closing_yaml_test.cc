#include "core/grasp/closing_yaml.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

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
