#include <gtest/gtest.h>

#include <cctype>

#include "core/physics/known_answers/known_answer.h"

namespace graspbench {
namespace {

class KnownAnswersTest : public testing::TestWithParam<KnownAnswerCheck> {};

TEST_P(KnownAnswersTest, AreObtained) {
  const std::vector<KnownAnswer> answers = GetParam().run();
  EXPECT_FALSE(answers.empty());
  for (const KnownAnswer& answer : answers) {
    EXPECT_TRUE(answer.passes()) << answer.what << ": expected " << answer.expected << " +- "
                                 << answer.tolerance << ' ' << answer.unit << ", obtained "
                                 << answer.obtained;
  }
}

INSTANTIATE_TEST_SUITE_P(Sheet, KnownAnswersTest, testing::ValuesIn(ListKnownAnswerChecks()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c : instance.param.name) {
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           }
                           return name;
                         });

}  // namespace
}  // namespace graspbench
