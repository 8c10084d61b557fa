#include "human_study/study/inference/shared_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/base/random.h"

namespace graspbench {
namespace {

struct SharingModel {
  double shared_sd = 0.0, own_sd = 0.02, clock_sd = 0.0, drift = 0.0, wander = 0.0,
         by_transport = 0.0;
  bool shows_transport = true;
};

std::vector<SharedTimingRun> MakeRuns(const SharingModel& model, const std::string& seed) {
  RandomStream random(seed, "shared timing");
  std::vector<SharedTimingRun> runs(4);
  for (SharedTimingRun& run : runs) {
    double walk = 0.0;
    for (int i = 0; i < 12; ++i) {
      walk += model.wander * random.NextNormal();
      SharedTimingTrial& trial = run.emplace_back();
      const double transport = random.NextNormal();
      trial.clock = model.clock_sd * random.NextNormal();
      trial.clock_noise = model.clock_sd;
      const double shared = model.shared_sd * random.NextNormal() + model.drift * i + walk +
                            model.by_transport * transport;
      for (int d = 0; d < 5; ++d) {
        trial.contacts.push_back(0.8 + shared + model.own_sd * random.NextNormal());
      }
      if (model.shows_transport) trial.transport = {0.1 + 0.01 * transport};
    }
  }
  return runs;
}

int CountShown(const SharingModel& model, const std::string& name) {
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const auto timing = CalcSharedTiming(MakeRuns(model, name + std::to_string(i)));
    EXPECT_TRUE(timing) << timing.reason();
    count += timing && timing->IsShown();
  }
  return count;
}

// 10 of 100 are passed by 1 % of tests at 5 %.
TEST(SharedTiming, WhatIsNoCoordinationIsNotShown) {
  EXPECT_LE(CountShown({}, "independent"), 10);
  SharingModel model;
  model.clock_sd = 0.02;
  EXPECT_LE(CountShown(model, "clock"), 10);
  model = SharingModel();
  model.drift = 0.01;  // of all digits, from each trial to the next
  EXPECT_LE(CountShown(model, "drift"), 10);
  model = SharingModel();
  model.by_transport = 0.03;
  EXPECT_LE(CountShown(model, "transport"), 10);
  model.shows_transport = false;
  EXPECT_GE(CountShown(model, "unseen transport"), 90);  // it is what the regression is for
}

// A random walk leaves half its squared step in the differences; that they do not alternate shows.
TEST(SharedTiming, TimesThatWanderAreSeldomCalledShared) {
  SharingModel model;
  model.wander = 0.01;
  model.clock_sd = 0.005;
  const int num_shown = CountShown(model, "wander");
  std::printf("wandering by 10 ms a trial is called shared in %d of 100\n", num_shown);
  EXPECT_LE(num_shown, 45);
  int num_without = 0;
  for (int i = 0; i < 100; ++i) {
    const auto timing = CalcSharedTiming(MakeRuns(model, "wander" + std::to_string(i)));
    num_without += timing->shared_low_sd > timing->clock_sd;
  }
  EXPECT_LT(num_shown, num_without);
}

TEST(SharedTiming, WhatIsSharedIsShownAndSizedRight) {
  SharingModel model;
  model.shared_sd = 0.03;
  model.clock_sd = 0.01;
  EXPECT_GE(CountShown(model, "shared"), 95);
  double variance = 0.0;
  for (int i = 0; i < 100; ++i) {
    const auto timing = CalcSharedTiming(MakeRuns(model, "size" + std::to_string(i)));
    variance += timing->shared_sd * timing->shared_sd / 100.0;
    EXPECT_NEAR(timing->clock_sd, 0.01, 1e-9);
  }
  // The digits share the delay and the clock's error.
  EXPECT_NEAR(variance, 0.03 * 0.03 + 0.01 * 0.01, 1e-4);
}

TEST(SharedTiming, GivesReasons) {
  EXPECT_EQ(CalcSharedTiming({}).reason(), "no two digits");
  std::vector<SharedTimingRun> runs = MakeRuns({}, "few");
  runs.resize(1);
  runs[0].resize(4);
  // 3 centred differences: (m - 1/m) 4 / (6 m - 2 - 4/m + 4/m^2) of m = 3 is 1.88, one feature.
  EXPECT_EQ(CalcSharedTiming(runs).reason(),
            "only 1 degrees of freedom beside what the transport explains; expected 5 or more");
}

}  // namespace
}  // namespace graspbench
