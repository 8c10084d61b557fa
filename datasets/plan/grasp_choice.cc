#include "datasets/plan/grasp_choice.h"

#include <algorithm>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "objects/catalogue.h"

namespace graspbench {

const Grasp* FindGrasp(const SessionHand& hand, const GraspObject& object, const std::string& id) {
  const auto grasp = std::find_if(hand.grasps.begin(), hand.grasps.end(), [&](const Grasp& g) {
    return g.id == id && (g.object.empty() || g.object == object.id);
  });
  return grasp == hand.grasps.end() ? nullptr : &*grasp;
}

namespace {

/** What an open hand needs beside an object that lies up to 5 mm aside [m]. */
constexpr double kRoomBetweenPads = 0.01;

/** The geometry of the placement alone decides; a distance field is made when its bounding box
leaves it open. */
bool CanReach(const SessionHand& hand, const Grasp& grasp,
              const std::shared_ptr<const GraspObject>& object) {
  return ReachesBoundingBox(*hand.hand, grasp, *object) ||
         CalcPlacement(*hand.hand, grasp, *CompleteObject(object)).reaches_object;
}

const Grasp& FindBestGrasp(const SessionHand& hand,
                           const std::shared_ptr<const GraspObject>& object) {
  const auto best = object->best_grasp.find(hand.hand->id);
  if (best != object->best_grasp.end()) {
    if (const Grasp* grasp = FindGrasp(hand, *object, best->second)) return *grasp;
  }
  const Grasp *first = nullptr, *first_reaching = nullptr;
  for (const std::string& id : object->grasp_order) {
    const Grasp* grasp = FindGrasp(hand, *object, id);
    if (!grasp) continue;
    if (grasp->placement) return *grasp;
    if (!first) first = grasp;
    const double width = CalcPreGraspWidth(*hand.hand, *grasp);
    const bool is_wide = width >= object->size.y() + kRoomBetweenPads;
    if ((!is_wide && first_reaching) || !CanReach(hand, *grasp, object)) continue;
    if (is_wide) return *grasp;
    first_reaching = grasp;
  }
  if (first_reaching) return *first_reaching;
  return first ? *first : hand.grasps.front();
}

/** What was looked at before "best" was chosen, and what else the session tries. */
std::vector<const Grasp*> ListTried(const SessionHand& hand, const GraspObject& object,
                                    const std::vector<const Grasp*>& chosen, bool takes_best) {
  std::vector<const Grasp*> tried;
  const auto add = [&](const Grasp* grasp) {
    if (grasp && std::find(tried.begin(), tried.end(), grasp) == tried.end()) {
      tried.push_back(grasp);
    }
  };
  if (takes_best) {
    for (const std::string& id : object.grasp_order) add(FindGrasp(hand, object, id));
  }
  for (const Grasp* grasp : chosen) add(grasp);
  return tried;
}

}  // namespace

std::string ResolveGraspName(const SessionInputs& inputs, const std::string& name) {
  const auto file = inputs.grasp_files.find(name);
  return file == inputs.grasp_files.end() ? name : file->second;
}

std::vector<const Grasp*> FindGrasps(const SessionConfig& config, const SessionInputs& inputs,
                                     const SessionHand& hand,
                                     const std::shared_ptr<const GraspObject>& object) {
  std::vector<const Grasp*> grasps;
  if (hand.grasps.empty()) return grasps;
  if (config.grasps.front() == "all") {
    for (const Grasp& grasp : hand.grasps) grasps.push_back(&grasp);
    return grasps;
  }
  for (const std::string& name : config.grasps) {
    const Grasp* grasp = name == "best" ? &FindBestGrasp(hand, object)
                                        : FindGrasp(hand, *object, ResolveGraspName(inputs, name));
    if (grasp && std::find(grasps.begin(), grasps.end(), grasp) == grasps.end()) {
      grasps.push_back(grasp);
    }
  }
  return grasps;
}

std::vector<UnreachedObject> FindUnreached(const SessionConfig& config,
                                           const SessionInputs& inputs) {
  std::vector<UnreachedObject> all;
  const bool takes_best = std::count(config.grasps.begin(), config.grasps.end(), "best") > 0;
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      if (takes_best && object->best_grasp.count(hand.hand->id) > 0) continue;
      const std::vector<const Grasp*> chosen = FindGrasps(config, inputs, hand, object);
      if (chosen.empty() || std::any_of(chosen.begin(), chosen.end(), [&](const Grasp* grasp) {
            return grasp->placement || CanReach(hand, *grasp, object);
          })) {
        continue;
      }
      UnreachedObject unreached{hand.hand->id, object->id, {}, "", 0.0};
      const auto complete = CompleteObject(object);
      for (const Grasp* grasp : ListTried(hand, *object, chosen, takes_best)) {
        const double miss = CalcReachMiss(*hand.hand, *grasp, *complete);
        if (unreached.tried.empty() || miss < unreached.miss) {
          unreached.nearest = grasp->id;
          unreached.miss = miss;
        }
        unreached.tried.push_back(grasp->id);
      }
      all.push_back(std::move(unreached));
    }
  }
  return all;
}

std::string DescribeUnreached(const UnreachedObject& unreached) {
  std::string tried;
  for (const std::string& id : unreached.tried) tried += (tried.empty() ? "" : ", ") + id;
  const bool is_one = unreached.tried.size() == 1;
  return unreached.hand + ", " + unreached.object + ": " +
         (is_one ? tried + " does not reach it" : "none of " + tried + " reaches it") +
         ", so every trial will be unreachable; " +
         (is_one ? "its" : "nearest is " + unreached.nearest + ", whose") + " pads stop " +
         FormatFixed(MmFromM(unreached.miss), 1) + " mm short";
}

}  // namespace graspbench
