#include "core/trial/grasp_by_sight.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"
#include "core/vision/suggest_grasp.h"

namespace graspbench {

TrialSetup ChooseGraspBySight(TrialSetup setup, std::unique_ptr<World> world, WristCamera* camera) {
  if (setup.sight_grasps.empty()) return setup;
  TrialSetup looking = setup;
  looking.positioning = Positioning::kNominal;  // else the course would look, too
  const Sighting seen = TableLift(std::move(world), looking).Look(camera);
  const std::vector<Grasp> grasps = std::exchange(setup.sight_grasps, {});
  if (!seen.is_found) {
    setup.sight = SightChoice{"", seen.reason};
    return setup;
  }
  const GraspType type = SuggestGraspType(seen);
  const auto chosen = std::find_if(grasps.begin(), grasps.end(),
                                   [&](const Grasp& grasp) { return grasp.type == type; });
  GRASPBENCH_DEMAND(chosen != grasps.end(), setup.hand->id);
  setup.grasp = *chosen;
  setup.sight = SightChoice{chosen->id, ""};
  return setup;
}

TrialSetup ChooseGraspBySight(TrialSetup setup) {
  if (setup.sight_grasps.empty()) return setup;
  auto world = std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim);
  return ChooseGraspBySight(std::move(setup), std::move(world), nullptr);
}

}  // namespace graspbench
