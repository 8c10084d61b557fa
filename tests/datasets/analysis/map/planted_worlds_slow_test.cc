#include <gtest/gtest.h>

#include <cstdio>

#include "core/base/enum_table.h"
#include "tests/datasets/analysis/map/planted_worlds.h"

namespace graspbench {
namespace {

// Seeds that nobody looked at while the analysis was written (below 1000) or that run with every
// change (1000 and 1001).
TEST(PlantedWorlds, AHundredOfEachKindGetTheirName) {
  for (const MapFinding truth :
       {MapFinding::kMatters, MapFinding::kNoEffect, MapFinding::kCommonCause}) {
    int num_right = 0, num_named = 0, num_covered = 0;
    for (uint64_t seed = 1000; seed < 1100; ++seed) {
      const PlantedWorld world = MakeWorld(truth, seed);
      const MapJudgement judged = JudgeWorld(world);
      num_right += judged.finding == truth ? 1 : 0;
      num_named += judged.cause == world.cause ? 1 : 0;
      num_covered +=
          judged.interval.low <= world.effect && world.effect <= judged.interval.high ? 1 : 0;
    }
    const char* const name = RowOf(kMapFindings, truth).name;
    std::printf("%s: %d of 100 named, cause right in %d, effect within its interval in %d\n", name,
                num_right, num_named, num_covered);
    EXPECT_GE(num_right, 95) << name;
    EXPECT_GE(num_named, 95) << name;
    EXPECT_GE(num_covered, 88) << name;
  }
}

}  // namespace
}  // namespace graspbench
