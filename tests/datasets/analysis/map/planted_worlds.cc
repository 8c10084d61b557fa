#include "tests/datasets/analysis/map/planted_worlds.h"

namespace graspbench {

MapJudgement JudgeWorld(PlantedWorld world) {
  world.data.factors[planted::kOffset].scales_draws = true;
  const std::string hand = world.data.trials.front().hand;
  const SimultaneityMap map = MapSimultaneity(world.data);
  const Answer<NaturalRelation> natural = FindNaturalRelation(world.data, hand);
  const MapCell& all = *FindCell(map, MapMeasure::kSuccess, hand, LateDigit::kLast, {});
  return {FindWhatMatters(map, natural, hand), natural ? natural->cause : natural.reason(),
          all.estimate, all.interval ? *all.interval : Interval{kUnset, kUnset}};
}

}  // namespace graspbench
