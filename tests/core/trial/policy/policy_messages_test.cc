// Wrong answers, each with what the outcome says of it; the manual's tables.

#include "core/trial/policy/policy_messages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/files/files.h"
#include "core/base/text/message_pack.h"
#include "core/trial/policy/policy_terms.h"

namespace graspbench {
namespace {

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
  EXPECT_EQ(ReadPolicyAction(MakeAnswer("targets", {1, 2}, {2}), 2).rows.rows(), 1);
  const PolicyAction action = ReadPolicyAction(MakeAnswer("increments", {1, 2, 3, 4}, {2, 2}), 2);
  EXPECT_TRUE(action.are_increments);
  EXPECT_EQ(action.rows(1, 0), 3.0);
  EXPECT_EQ(ReadPolicyAnswerNumber(MakeAnswer("targets", {1}, {1})), 3u);
}

TEST(PolicyMessages, SaysWhatIsWrongWithAnAnswer) {
  const double nan = std::nan("");
  const std::pair<std::string, std::string> cases[] = {
      {"no message", "no MessagePack"},
      {"\x93\x01\x02\x03", "no map"},
      {"\x80", "no targets, no increments and no done"},
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
      {MakeAnswer("targets", std::vector<double>(2002), {1001, 2}), "1001 rows; at most 1000"}};
  for (const auto& [answer, expected] : cases) {
    try {
      ReadPolicyAction(answer, 2);
      ADD_FAILURE() << expected;
    } catch (const PolicyFault& fault) {
      EXPECT_NE(std::string(fault.what()).find(expected), std::string::npos) << fault.what();
    }
  }
  EXPECT_THROW(ReadPolicyAnswerNumber("\x80"), PolicyFault);
  EXPECT_THROW(CheckPolicyReset(MakeAnswer("targets", {1, 2}, {2})), PolicyFault);
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
