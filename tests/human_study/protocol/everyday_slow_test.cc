/** @file
Figures over 100 studies a case, each of files, as ../../../human_study/ACCURACY.md has them. */

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/human_study/protocol/everyday_study.h"

namespace graspbench::everyday {
namespace {

std::filesystem::path SlowScratch() {
  return std::filesystem::path(::testing::TempDir()) /
         (std::string("everyday_slow_") +
          ::testing::UnitTest::GetInstance()->current_test_info()->name());
}

constexpr int kNumStudies = 100;
constexpr int kNumRecorded = 12;

void Print(const NamedPlan& named, const Verdicts& verdicts) {
  std::printf("%-40s more %3d less %3d not decided %3d no difference %3d none %d\n",
              named.name.c_str(), verdicts.num_more, verdicts.num_less, verdicts.num_not_decided,
              verdicts.num_no_difference, verdicts.num_none);
  std::fflush(stdout);
}

TEST(EverydaySlow, IndependentDigitsAreCalledMoreSimultaneousInTenPerCentAtMost) {
  for (const NamedPlan& named : ListIndependentPeople()) {
    const Verdicts verdicts = CountVerdictsOfEvents(named.plan, kNumStudies);
    Print(named, verdicts);
    EXPECT_LE(verdicts.num_more, kNumStudies / 10) << named.name;
    EXPECT_EQ(verdicts.num_none, 0) << named.name;
  }
}

TEST(EverydaySlow, DigitsThatShareADelayAreFoundInNinetyPerCent) {
  for (const NamedPlan& named : ListCoordinatedPeople()) {
    const Verdicts verdicts = CountVerdictsOfEvents(named.plan, kNumStudies);
    Print(named, verdicts);
    EXPECT_GE(verdicts.num_more, kNumStudies * 9 / 10) << named.name;
  }
}

TEST(EverydaySlow, FromRecordingsTheVerdictsAreTheSame) {
  for (const NamedPlan& named : ListIndependentPeople()) {
    const Verdicts verdicts = CountVerdicts(named.plan, kNumRecorded, SlowScratch());
    Print(named, verdicts);
    EXPECT_LE(verdicts.num_more, 1) << named.name;
  }
  for (const NamedPlan& named : ListCoordinatedPeople()) {
    const Verdicts verdicts = CountVerdicts(named.plan, kNumRecorded, SlowScratch());
    Print(named, verdicts);
    EXPECT_GE(verdicts.num_more, 11) << named.name;
  }
}

}  // namespace
}  // namespace graspbench::everyday
