#include "core/trial/outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace graspbench {
namespace {

TEST(Outcome, EveryValueHasOneRowInTheOrderOfTheEnum) {
  int number = 0;
  for (const OutcomeRow& row : kOutcomes) EXPECT_EQ(static_cast<int>(row.value), number++);
  EXPECT_EQ(ListOutcomes().size(), static_cast<size_t>(kNumOutcomes));
  EXPECT_EQ(ListOutcomes().front(), Outcome::kSuccess);
}

TEST(Outcome, OneIsSuccessOneIsNumericalAndNoneIsBoth) {
  const auto count = [](bool (*rule)(Outcome)) {
    return std::count_if(ListOutcomes().begin(), ListOutcomes().end(), rule);
  };
  EXPECT_EQ(count(IsSuccess), 1);
  EXPECT_EQ(count(IsNumericalFailure), 1);
  EXPECT_TRUE(IsSuccess(Outcome::kSuccess));
  EXPECT_TRUE(IsNumericalFailure(Outcome::kNumericalFailure));
  std::set<std::string> names, codes;
  for (const Outcome outcome : ListOutcomes()) {
    EXPECT_EQ(OutcomeFromName(NameOf(outcome)), outcome);
    names.insert(NameOf(outcome));
    codes.insert(CodeOf(outcome));
    EXPECT_LE(IsSuccess(outcome) + IsNumericalFailure(outcome) + IsOutOfReach(outcome), 1);
    EXPECT_FALSE(MayBeInHand(outcome) && IsOutOfReach(outcome)) << NameOf(outcome);
  }
  EXPECT_EQ(names.size(), ListOutcomes().size());
  EXPECT_EQ(codes.size(), ListOutcomes().size());
  EXPECT_THROW(OutcomeFromName("not run"), Error);
  EXPECT_TRUE(MayBeInHand(Outcome::kDroppedWhileHolding));
  EXPECT_FALSE(MayBeInHand(Outcome::kNoContact));
}

}  // namespace
}  // namespace graspbench
