#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

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

TEST(KnownAnswer, PassesWithinItsToleranceOnly) {
  EXPECT_TRUE((KnownAnswer{"", "m", 1.0, 1.5, 0.5}.passes()));
  EXPECT_FALSE((KnownAnswer{"", "m", 1.0, 1.6, 0.5}.passes()));
  EXPECT_FALSE((KnownAnswer{"", "m", 1.0, 0.4, 0.5}.passes()));
  EXPECT_FALSE((KnownAnswer{"", "m", 0.0, std::nan(""), 1.0}.passes()));
}

}  // namespace
}  // namespace graspbench
