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

TEST(Outcome, NamesAndCodesTellThemApart) {
  std::set<std::string> names, codes;
  for (const Outcome outcome : ListOutcomes()) {
    EXPECT_EQ(OutcomeFromName(NameOf(outcome)), outcome);
    EXPECT_EQ(std::string(CodeOf(outcome)).size(), 2u);
    names.insert(NameOf(outcome));
    codes.insert(CodeOf(outcome));
  }
  EXPECT_EQ(names.size(), ListOutcomes().size());
  EXPECT_EQ(codes.size(), ListOutcomes().size());
}

TEST(Outcome, OneIsSuccessOneIsNumericalAndNoneIsBoth) {
  const auto count = [](bool (*rule)(Outcome)) {
    return std::count_if(ListOutcomes().begin(), ListOutcomes().end(), rule);
  };
  EXPECT_EQ(count(IsSuccess), 1);
  EXPECT_EQ(count(IsNumericalFailure), 1);
  EXPECT_TRUE(IsSuccess(Outcome::kSuccess));
  EXPECT_TRUE(IsNumericalFailure(Outcome::kNumericalFailure));
  for (const Outcome outcome : ListOutcomes()) {
    EXPECT_LE(IsSuccess(outcome) + IsNumericalFailure(outcome) + IsOutOfReach(outcome), 1);
    EXPECT_FALSE(MayBeInHand(outcome) && IsOutOfReach(outcome)) << NameOf(outcome);
  }
  EXPECT_TRUE(MayBeInHand(Outcome::kDroppedWhileHolding));
  EXPECT_FALSE(MayBeInHand(Outcome::kNoContact));
}

TEST(Outcome, WhatWasNotRunIsNoResult) {
  EXPECT_STREQ(NameOf(Outcome::kNotRun), "not run");
  EXPECT_FALSE(IsSuccess(Outcome::kNotRun) || IsNumericalFailure(Outcome::kNotRun));
  for (const char* name : {"not run", "", "Success", "no contac"}) {
    EXPECT_THROW(OutcomeFromName(name), Error) << name;
  }
}

}  // namespace
}  // namespace graspbench
