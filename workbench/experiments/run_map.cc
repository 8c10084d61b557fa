#include "workbench/experiments/run_map.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "datasets/plan/map_design.h"
#include "workbench/experiments/run_sweep.h"

namespace graspbench {
namespace {

/** Some of the objects, dealt by the seed, in their order; all where there are no more. */
std::vector<std::string> DealObjects(const SessionInputs& inputs,
                                     const std::vector<std::string>& names, int count, int seed) {
  std::vector<std::string> objects = names;
  if (names == SessionConfig().objects) {
    objects.clear();
    for (const auto& object : inputs.objects) objects.push_back(object->id);
  }
  RandomStream random(std::to_string(seed), "objects of a map");
  while (static_cast<int>(objects.size()) > count) {
    objects.erase(objects.begin() + random.NextIndex(static_cast<int>(objects.size())));
  }
  return objects;
}

/** Copies of one body would count as so many objects to draw from.
@throws Error(kUsage). */
void CheckObjectsDiffer(const SessionInputs& inputs) {
  std::map<std::string, std::string> ids;
  for (const auto& object : inputs.objects) {
    const auto [first, is_new] = ids.emplace(object->content_hash, object->id);
    if (is_new) continue;
    throw Error(ErrorKind::kUsage,
                "the objects \"" + first->second + "\" and \"" + object->id +
                    "\" are the same body (mesh, mass and surface); a map draws objects, so copies "
                    "would feign certainty: leave one of them out");
  }
}

}  // namespace

PreparedSession PrepareMap(const MapRequest& request) {
  CheckObjectsDiffer(LoadSessionInputs(request.base, FieldUse::kLater));
  SessionRequest session;
  session.config = MakeMapSession(ListMapParts(request.is_quick).front(), request.base);
  session.name = "map";
  session.out = request.out;
  session.resume = HasSession(request.out);
  session.on_damage = request.on_damage;
  return PrepareSession(session);
}

bool RunMap(const PreparedSession& success, const MapRequest& request, int num_workers,
            Observer& observer, const std::atomic<bool>& stop) {
  for (const MapPart& part : ListMapParts(request.is_quick)) {
    ExperimentRequest rest;
    rest.with_judge = part.with_judge;
    rest.on_damage = request.on_damage;
    rest.trial_time_limit = request.trial_time_limit;
    const ThresholdScale* const scale =
        part.with_thresholds ? &RowFromName(kThresholdScales, "margin", "threshold") : nullptr;
    if (part.varies_grip) {
      if (!RunSweep(success, scale, rest, num_workers, observer, stop)) return false;
      continue;
    }
    SessionRequest session;
    SessionConfig base = request.base;
    if (part.most_objects > 0) {
      base.objects = DealObjects(success.inputs, base.objects, part.most_objects, base.seed);
    }
    session.config = MakeMapSession(part, base);
    session.out = success.folder / "map" / part.id;
    session.resume = HasSession(session.out);
    session.on_damage = request.on_damage;
    if (!RunSweep(PrepareSession(session), scale, rest, num_workers, observer, stop)) return false;
  }
  return true;
}

}  // namespace graspbench
