#include "datasets/analysis/map/common_cause.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/datasets/analysis/map/planted_worlds.h"

namespace graspbench {
namespace {

struct Verdict {
  MapFinding finding;
  std::string cause;
  double estimate, low, high;
};

Verdict Judge(PlantedWorld world) {
  world.data.factors[planted::kOffset].scales_draws = true;
  const std::string hand = world.data.trials.front().hand;
  const SimultaneityMap map = MapSimultaneity(world.data);
  const Answer<NaturalRelation> natural = FindNaturalRelation(world.data, hand);
  const MapCell& all = *FindCell(map, MapMeasure::kSuccess, hand, LateDigit::kLast, {});
  return {FindWhatMatters(map, natural, hand), natural ? natural->cause : natural.reason(),
          all.estimate, all.interval ? all.interval->low : kUnset,
          all.interval ? all.interval->high : kUnset};
}

// Worlds by planted_worlds.h, which knows nothing of the analysis. Seeds below 1000 were looked at
// while it was written.
TEST(CommonCause, PlantedWorldsGetTheirName) {
  int num_right = 0, num_all = 0, num_causes = 0, num_covered = 0;
  for (const MapFinding truth :
       {MapFinding::kMatters, MapFinding::kNoEffect, MapFinding::kCommonCause}) {
    std::map<std::string, int> found;
    for (uint64_t seed = 1000; seed < 1007; ++seed) {
      const PlantedWorld world = MakeWorld(truth, seed);
      const Verdict verdict = Judge(world);
      ++found[RowOf(kMapFindings, verdict.finding).name];
      num_right += verdict.finding == truth;
      num_causes += truth == MapFinding::kCommonCause && verdict.cause == world.cause;
      num_covered += verdict.low <= world.effect && world.effect <= verdict.high;
      ++num_all;
    }
    for (const auto& [name, count] : found) {
      std::printf("%s: %s %d\n", RowOf(kMapFindings, truth).name, name.c_str(), count);
    }
  }
  std::printf("right %d of %d, causes %d of 7, effect within its interval %d\n", num_right, num_all,
              num_causes, num_covered);
  EXPECT_GE(num_right, num_all - 1);
  EXPECT_GE(num_causes, 6);
  EXPECT_GE(num_covered, num_all - 3);
}

}  // namespace
}  // namespace graspbench
