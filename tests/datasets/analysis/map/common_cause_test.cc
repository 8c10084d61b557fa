#include "datasets/analysis/map/common_cause.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/map/planted_worlds.h"

namespace graspbench {
namespace {

// Worlds by planted_worlds.h, which knows nothing of the analysis. Those with seeds below 1000 were
// looked at while it was written; of a hundred others of each kind see the validation page.
TEST(CommonCause, PlantedWorldsGetTheirName) {
  for (const MapFinding truth :
       {MapFinding::kMatters, MapFinding::kNoEffect, MapFinding::kCommonCause}) {
    for (uint64_t seed = 1000; seed < 1002; ++seed) {
      const PlantedWorld world = MakeWorld(truth, seed);
      const MapJudgement verdict = JudgeWorld(world);
      const std::string what = RowOf(kMapFindings, truth).name + std::to_string(seed);
      EXPECT_EQ(verdict.finding, truth) << what;
      if (truth == MapFinding::kCommonCause) {
        EXPECT_EQ(verdict.cause, world.cause) << what;
      }
      EXPECT_NEAR(verdict.estimate, world.effect, 0.012) << what;
    }
  }
}

// Success depends on the lateness alone, which depends on nothing: no cause is made up.
TEST(CommonCause, ARelationWithoutACauseHasNone) {
  const PlantedWorld world = MakeWorld(MapFinding::kMatters, 1000);
  const Answer<NaturalRelation> natural =
      FindNaturalRelation(world.data, world.data.trials.front().hand);
  ASSERT_TRUE(natural) << natural.reason();
  EXPECT_EQ(natural->cause, "");
}

TEST(CommonCause, WithoutTrialsThereIsNoRelation) { EXPECT_FALSE(FindNaturalRelation({}, "tum")); }

}  // namespace
}  // namespace graspbench
