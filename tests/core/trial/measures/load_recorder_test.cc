#include "core/trial/measures/load_recorder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trial/protocols/table_lift.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

/** A cube held by two digits of the TUM Hand; from `push_at` on a load acts for 50 ms. */
std::vector<LoadSample> Watch(double push_at, const Eigen::Vector3d& push_W) {
  const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  TrialRunner runner(setup.hand, setup.object);
  std::vector<LoadSample> samples;
  runner.Run(setup, [&](TrialCourse& course) {
    const double since = course.time() - push_at;
    course.world().SetExternalLoad(
        since >= 0.0 && since < 0.05 ? push_W : Eigen::Vector3d::Zero().eval(),
        Eigen::Vector3d::Zero());
    samples = dynamic_cast<TableLift&>(course).notes().loads.samples();
  });
  return samples;
}

TEST(LoadRecorder, HandAndTableExplainTheObjectsMotion) {
  const std::vector<LoadSample> samples = Watch(kUnset, Eigen::Vector3d::Zero());
  ASSERT_GT(samples.size(), 100u);
  for (size_t i = 1; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].time - samples[i - 1].time, 0.01, 0.009) << i;
    EXPECT_LT(samples[i].push, 0.01) << samples[i].time << " s: weight 0.12 N";
  }
  // Two digits press alike and the rest not at all.
  const LoadSample& last = samples.back();
  ASSERT_EQ(last.parts.size(), 3u);
  EXPECT_GT(last.parts[0].force, 0.1);
  EXPECT_NEAR(last.parts[0].force, last.parts[1].force, 0.1 * last.parts[0].force);
  EXPECT_NEAR(last.parts[0].normal_W.norm(), last.parts[0].force, 0.1 * last.parts[0].force);
  EXPECT_LT((last.parts[0].normal_W + last.parts[1].normal_W).norm(), 0.2 * last.parts[0].force);
  EXPECT_EQ(last.parts[2].force, 0.0);
  EXPECT_EQ(last.table_force, 0.0);
}

TEST(LoadRecorder, APushIsSeenWithItsForceAndTime) {
  const Eigen::Vector3d push_W(0.3, 0.0, 0.4);
  const std::vector<LoadSample> samples = Watch(3.0, push_W);
  double most = 0.0;
  for (const LoadSample& sample : samples) {
    const bool is_pushed = sample.time > 2.99 && sample.time < 3.07;
    if (!is_pushed) {
      EXPECT_LT(sample.push, 0.01) << sample.time;
    }
    if (sample.table_force == 0.0) most = std::fmax(most, sample.push);
  }
  EXPECT_NEAR(most, 0.3 + 0.4, 0.02) << "across and up";
}

}  // namespace
}  // namespace graspbench
