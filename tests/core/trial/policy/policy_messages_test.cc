// Wrong answers, each with what the outcome says of it; the manual's tables.

#include "core/trial/policy/policy_messages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/files/files.h"
#include "core/base/text/message_pack.h"
#include "core/trial/policy/policy_terms.h"

namespace graspbench {
namespace {

PolicyAction ReadAction(const std::string& answer) {
  return ReadPolicyAction(ParsePolicyAnswer(answer), 2);
}

std::string MakeAnswer(const std::string& key, const std::vector<double>& values,
                       const std::vector<size_t>& shape) {
  MessagePackWriter writer;
  writer.Map(2);
  writer.Text("number");
  writer.Integer(3);
  writer.Text(key);
  writer.Array(values.data(), shape);
  return writer.bytes();
}

TEST(PolicyMessages, TakesOneRowOrSeveral) {
  EXPECT_EQ(ReadAction(MakeAnswer("targets", {1, 2}, {2})).rows.rows(), 1);
  const PolicyAction action = ReadAction(MakeAnswer("increments", {1, 2, 3, 4}, {2, 2}));
  EXPECT_TRUE(action.are_increments);
  EXPECT_EQ(action.rows(1, 0), 3.0);
  EXPECT_EQ(ReadPolicyAnswerNumber(ParsePolicyAnswer(MakeAnswer("targets", {1}, {1}))), 3u);
}

/** An answer of several arrays. */
std::string MakeAnswer(
    const std::vector<std::pair<std::string, std::vector<std::vector<double>>>>& values) {
  MessagePackWriter writer;
  writer.Map(values.size());
  for (const auto& [key, rows] : values) {
    writer.Text(key);
    std::vector<double> flat;
    for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
    writer.Array(flat.data(), {rows.size(), rows.at(0).size()});
  }
  return writer.bytes();
}

TEST(PolicyMessages, OneRowIsThatOfAll) {
  const PolicyAction action =
      ReadAction(MakeAnswer({{"hand_twist", {{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}}},
                             {"targets", {{1, 2}}},
                             {"stiffness", {{0.5, 1}}}}));
  EXPECT_EQ(action.rows.rows(), 2);
  EXPECT_EQ(action.rows(1, 1), 2.0);
  EXPECT_EQ(action.stiffness(1, 0), 0.5);
  EXPECT_EQ(action.twists(1, 5), 12.0);
}

TEST(PolicyMessages, APoseIsAPositionAndAQuaternion) {
  const double half = std::sqrt(0.5);
  const PolicyAction action =
      ReadAction(MakeAnswer({{"hand_pose", {{1, 2, 3, half, 0, 0, half}}}}));
  ASSERT_EQ(action.poses.size(), 1u);
  EXPECT_EQ(action.rows.rows(), 0);
  const Eigen::Vector3d p = action.poses[0] * Eigen::Vector3d(1, 0, 0);
  EXPECT_NEAR((p - Eigen::Vector3d(1, 3, 3)).norm(), 0.0, 1e-12) << "a quarter turn about z";
}

TEST(PolicyMessages, HoldNamesAGrip) {
  const auto make = [](const char* grip) {
    MessagePackWriter writer;
    writer.Map(1);
    writer.Text("hold");
    writer.Text(grip);
    return writer.bytes();
  };
  EXPECT_EQ(ReadAction(make("margin")).hold, GripMode::kMargin);
  EXPECT_EQ(ReadAction(make("force")).hold, GripMode::kForce);
  EXPECT_THROW(ReadAction(make("posture")), PolicyFault);
}

TEST(PolicyMessages, SaysWhatIsWrongWithAnAnswer) {
  const double nan = std::nan("");
  const std::pair<std::string, std::string> cases[] = {
      {"no message", "no MessagePack"},
      {"\x93\x01\x02\x03", "no map"},
      {"\x80", "no targets, no increments, no motion of the hand and no done"},
      {"\x81\xa4"
       "done\x01",
       "neither true nor false"},
      {"\x81\xa5"
       "error\xa4"
       "lost",
       "gave up: \"lost\""},
      {"\x81\xa4"
       "joke\x01",
       "has the key \"joke\""},
      {"\x81\xa7"
       "targets\xa1"
       "x",
       "no array of numbers"},
      {MakeAnswer("targets", {1, 2, 3}, {3}), "(3,); expected (2,) or (rows, 2)"},
      {MakeAnswer("targets", {}, {0, 2}), "(0, 2); expected"},
      {MakeAnswer("targets", {1, nan}, {2}), "NaN in row 0, column 1"},
      {MakeAnswer("increments", {1, 2, INFINITY, 4}, {2, 2}), "infinite number in row 1, column 0"},
      {MakeAnswer("targets", std::vector<double>(2002), {1001, 2}), "1001 rows; at most 1000"},
      {MakeAnswer("hand_pose", {0, 0, 0, 0, 0, 0, 0}, {7}), "in row 0 has the length 0"},
      {MakeAnswer("hand_twist", {0, 0, 0}, {3}), "(3,); expected (6,) or (rows, 6)"},
      {MakeAnswer({{"targets", {{1, 2}, {3, 4}}}, {"stiffness", {{1, 1}, {1, 1}, {1, 1}}}}),
       "stiffness has 3 rows; expected 2, as targets has, or one"},
      {MakeAnswer({{"hand_pose", {{0, 0, 0, 1, 0, 0, 0}}}, {"hand_twist", {{0, 0, 0, 0, 0, 0}}}}),
       "hand_pose and hand_twist; give one"},
      {MakeAnswer({{"targets", {{1, 2}}}, {"increments", {{1, 2}}}}),
       "targets and increments; give one"}};
  for (const auto& [answer, expected] : cases) {
    try {
      ReadAction(answer);
      ADD_FAILURE() << expected;
    } catch (const PolicyFault& fault) {
      EXPECT_NE(std::string(fault.what()).find(expected), std::string::npos) << fault.what();
    }
  }
  EXPECT_THROW(ReadPolicyAnswerNumber(ParsePolicyAnswer("\x80")), PolicyFault);
  EXPECT_THROW(CheckPolicyReset(ParsePolicyAnswer(MakeAnswer("targets", {1, 2}, {2}))),
               PolicyFault);
}

TEST(PolicyTerms, AreTheTablesOfTheManual) {
  const auto page = FindDataRoot() / "workbench" / "manual" / "pages" / "controllers.md";
  if (!std::filesystem::exists(page)) GTEST_SKIP() << "no manual's source here";
  EXPECT_NE(ReadFile(page).find(FormatPolicyTerms()), std::string::npos)
      << "expected in " << page << ":\n"
      << FormatPolicyTerms();
}

}  // namespace
}  // namespace graspbench
