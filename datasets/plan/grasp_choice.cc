#include "datasets/plan/grasp_choice.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/trial/measures/grasp_types.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

namespace {

bool NamesBySight(const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), kBySight) != names.end();
}

bool CanTake(const SessionInputs& inputs, const SessionHand& hand, const Grasp& grasp,
             const std::shared_ptr<const GraspObject>& object) {
  if (grasp.placement) return true;
  const GraspPrediction& prediction = inputs.fitted->Find(hand.hand, grasp, object).prediction;
  return prediction.reaches() && prediction.is_clear() && prediction.meets();
}

const Grasp& ChooseBestGrasp(const SessionInputs& inputs, const SessionHand& hand,
                             const std::shared_ptr<const GraspObject>& object) {
  const auto named = object->best_grasp.find(hand.hand->id);
  if (named != object->best_grasp.end()) {
    if (const Grasp* grasp = FindGrasp(hand, *object, named->second)) return *grasp;
  }
  const Grasp* best = nullptr;
  GraspRank best_rank;
  for (const std::string& id : object->grasp_order) {
    const Grasp* grasp = FindGrasp(hand, *object, id);
    if (!grasp || !IsGraspFor(*grasp, *object)) continue;
    if (grasp->placement) return *grasp;
    const GraspRank rank =
        RankGrasp(*grasp, inputs.fitted->Find(hand.hand, *grasp, object).prediction);
    if (!(rank > best_rank)) continue;
    best = grasp;
    best_rank = rank;
  }
  return best ? *best : hand.grasps.front();
}

/** Under a condition the one that the base chooses; null: the hand does not have it here. */
const Grasp* FindBestGrasp(const SessionInputs& inputs, const SessionHand& hand,
                           const std::shared_ptr<const GraspObject>& object) {
  if (!inputs.base) return &ChooseBestGrasp(inputs, hand, object);
  const SessionInputs& base = *inputs.base;
  const auto base_hand =
      std::find_if(base.hands.begin(), base.hands.end(),
                   [&](const SessionHand& one) { return one.hand->id == hand.hand->id; });
  const auto base_object = std::find_if(base.objects.begin(), base.objects.end(),
                                        [&](const auto& one) { return one->id == object->id; });
  GRASPBENCH_DEMAND(base_hand != base.hands.end() && base_object != base.objects.end(),
                    hand.hand->id + ", " + object->id);
  return FindGrasp(hand, *object, ChooseBestGrasp(base, *base_hand, *base_object).id);
}

/** What each name of the session stands for on an object: one grasp, all those of which the camera
chooses, those that "best" is chosen of, or "all". Names whose choice is believed are left out. */
std::vector<std::vector<const Grasp*>> ListTried(const SessionConfig& config,
                                                 const SessionInputs& inputs,
                                                 const SessionHand& hand,
                                                 const std::shared_ptr<const GraspObject>& object) {
  std::vector<std::vector<const Grasp*>> tried;
  for (const std::string& name : config.grasps) {
    std::vector<const Grasp*> group;
    const auto add = [&](const Grasp* grasp) {
      if (grasp) group.push_back(grasp);
    };
    if (name == "all") {
      for (const Grasp& grasp : hand.grasps) add(FindGrasp(hand, *object, grasp.id));
    } else if (name == kBySight) {
      group = FindSightGrasps(hand, *object);
    } else if (name != "best") {
      add(FindGrasp(hand, *object, ResolveGraspName(inputs, name)));
    } else if (object->best_grasp.count(hand.hand->id) == 0) {
      for (const std::string& id : object->grasp_order) add(FindGrasp(hand, *object, id));
    }
    if (!group.empty()) tried.push_back(std::move(group));
  }
  return tried;
}

/** An object that a hand cannot take by one of the session's names of grasps: none that it stands
for reaches it, comes to it clear of it and meets it. */
struct UnreachedObject {
  std::string hand, object;
  std::vector<std::string> tried;  ///< ids of grasps, the object's order for "best"
  std::string nearest;             ///< of these
  double miss = 0.0;               ///< by which its pads stop short [m]; 0: it reaches the object
  double lacking_room = 0.0;       ///< of one that reaches it, beside the open digits [m]
  double width = 0.0;              ///< the object's, the smaller one on the table [m]
  double opening = 0.0;            ///< of the nearest grasp's pads [m]
};

std::vector<UnreachedObject> FindUnreached(const SessionConfig& config,
                                           const SessionInputs& inputs) {
  std::vector<UnreachedObject> all;
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      for (const auto& tried : ListTried(config, inputs, hand, object)) {
        const auto can_take = [&](const Grasp* grasp) {
          return CanTake(inputs, hand, *grasp, object);
        };
        if (std::any_of(tried.begin(), tried.end(), can_take)) continue;
        UnreachedObject unreached;
        unreached.hand = hand.hand->id;
        unreached.object = object->id;
        unreached.width = std::min(object->size.x(), object->size.y());
        for (const Grasp* grasp : tried) {
          const auto& [fitted, prediction] = inputs.fitted->Find(hand.hand, *grasp, object);
          const double miss = prediction.reach_miss;
          const double lacking = std::max(0.0, prediction.needed_room - prediction.room);
          if (unreached.tried.empty() ||
              std::pair(miss, lacking) < std::pair(unreached.miss, unreached.lacking_room)) {
            unreached.nearest = grasp->id;
            unreached.miss = miss;
            unreached.lacking_room = lacking;
            unreached.opening = CalcPreGraspWidth(*hand.hand, fitted);
          }
          unreached.tried.push_back(grasp->id);
        }
        all.push_back(std::move(unreached));
      }
    }
  }
  return all;
}

std::string DescribeUnreached(const UnreachedObject& unreached) {
  std::string tried;
  for (const std::string& id : unreached.tried) tried += (tried.empty() ? "" : ", ") + id;
  const bool is_one = unreached.tried.size() == 1;
  const std::string who =
      unreached.hand + ", " + unreached.object + ": " + (is_one ? tried : "none of " + tried);
  const auto format = [](double length) { return FormatFixed(MmFromM(length), 1) + " mm"; };
  if (unreached.miss > 0.0) {
    const bool is_wide = unreached.opening > 0.0 && unreached.width > unreached.opening;
    return who + (is_one ? " does not reach it" : " reaches it") +
           ", so every trial will be unreachable; " +
           (is_one ? "its" : "nearest is " + unreached.nearest + ", whose") + " pads stop " +
           format(unreached.miss) + " short" +
           (is_wide ? ": it is " + format(unreached.width) + " wide, and they open to " +
                          format(unreached.opening)
                    : "");
  }
  if (unreached.lacking_room > 0.0) {
    return who + (is_one ? " is not" : " is") +
           " clear of it wherever a draw puts it, so digits may touch it before they close; " +
           (is_one ? "it" : "nearest is " + unreached.nearest + ", which") + " lacks " +
           format(unreached.lacking_room) + " beside the object";
  }
  return who + (is_one ? " does not meet it" : " meets it") +
         " with its opposing digit and another when it closes";
}

}  // namespace

bool NeedsCamera(const SessionConfig& config) {
  return config.positioning == RowOf(kPositionings, Positioning::kCamera).name ||
         NamesBySight(config.grasps);
}

bool ShowsCamera(const PolicyConfig& policy) {
  return !policy.command.empty() &&
         (policy.picture > 0 ||
          policy.object_pose == RowOf(kPolicyObjectPoses, PolicyObjectPose::kCamera).name);
}

bool HasGraspBySight(const SessionConfig& config) {
  return NamesBySight(config.grasps) ||
         std::any_of(config.conditions.begin(), config.conditions.end(),
                     [setting = std::string("grasp=") + kBySight](const Condition& condition) {
                       const auto& all = condition.settings;
                       return std::find(all.begin(), all.end(), setting) != all.end();
                     });
}

const Grasp* FindGrasp(const SessionHand& hand, const GraspObject& object, const std::string& id) {
  const auto grasp = std::find_if(hand.grasps.begin(), hand.grasps.end(), [&](const Grasp& g) {
    return g.id == id && (g.object.empty() || g.object == object.id);
  });
  return grasp == hand.grasps.end() ? nullptr : &*grasp;
}

Grasp FindFitted(const SessionInputs& inputs, const SessionHand& hand, const Grasp& grasp,
                 const std::shared_ptr<const GraspObject>& object) {
  const auto named = object->best_grasp.find(hand.hand->id);
  const bool is_named = named != object->best_grasp.end() && named->second == grasp.id;
  if (is_named || grasp.placement || !grasp.object.empty()) return grasp;
  if (!grasp.palm_may_touch && ClearsBoundingBox(*hand.hand, grasp, *object)) return grasp;
  return inputs.fitted->Find(hand.hand, grasp, object).grasp;
}

std::string ResolveGraspName(const SessionInputs& inputs, const std::string& name) {
  const auto file = inputs.grasp_files.find(name);
  return file == inputs.grasp_files.end() ? name : file->second;
}

std::vector<const Grasp*> FindSightGrasps(const SessionHand& hand, const GraspObject& object) {
  std::vector<const Grasp*> grasps;
  for (const GraspType type :
       {GraspType::kAllFingerPrecision, GraspType::kTwoFingerPrecision, GraspType::kPower}) {
    const Grasp* found = nullptr;
    std::string missing;
    for (const GraspTaxon& taxon : ListGraspTaxa()) {
      if (taxon.type != type || found) continue;
      found = FindGrasp(hand, object, taxon.id);
      missing += (missing.empty() ? "" : " or ") + taxon.id + " (" + taxon.name + ")";
    }
    if (!found) {
      throw Error(ErrorKind::kUsage, "the hand \"" + hand.hand->id + "\" has no grasp " + missing +
                                         ", which --grasp by-sight may choose; add it to its "
                                         "hand.yaml (graspbench help hand.yaml), or name a grasp");
    }
    grasps.push_back(found);
  }
  return grasps;
}

std::vector<GraspEntry> ListGraspEntries(const SessionConfig& config, const SessionInputs& inputs,
                                         const SessionHand& hand,
                                         const std::shared_ptr<const GraspObject>& object) {
  std::vector<GraspEntry> entries;
  if (hand.grasps.empty()) return entries;
  if (config.grasps.front() == "all") {
    for (const Grasp& grasp : hand.grasps) entries.push_back({grasp.id, {&grasp}});
    return entries;
  }
  for (const std::string& name : config.grasps) {
    if (name == kBySight) {
      entries.push_back({kBySight, FindSightGrasps(hand, *object)});
      continue;
    }
    const Grasp* grasp = name == "best" ? FindBestGrasp(inputs, hand, object)
                                        : FindGrasp(hand, *object, ResolveGraspName(inputs, name));
    const bool is_new =
        grasp && std::none_of(entries.begin(), entries.end(), [&](const GraspEntry& entry) {
          return entry.id != kBySight && entry.grasps.front() == grasp;
        });
    if (is_new) entries.push_back({grasp->id, {grasp}});
  }
  return entries;
}

std::vector<const Grasp*> FindGrasps(const SessionConfig& config, const SessionInputs& inputs,
                                     const SessionHand& hand,
                                     const std::shared_ptr<const GraspObject>& object) {
  std::vector<const Grasp*> grasps;
  for (const GraspEntry& entry : ListGraspEntries(config, inputs, hand, object)) {
    for (const Grasp* grasp : entry.grasps) {
      if (std::find(grasps.begin(), grasps.end(), grasp) == grasps.end()) grasps.push_back(grasp);
    }
  }
  return grasps;
}

std::vector<std::string> ListObjectWarnings(const SessionConfig& config,
                                            const SessionInputs& inputs) {
  const double kTipsOver = RadFromDeg(5.0);  // beyond what a rough surface rocks
  std::vector<std::string> warnings;
  for (const UnreachedObject& unreached : FindUnreached(config, inputs)) {
    warnings.push_back(DescribeUnreached(unreached));
  }
  for (const auto& object : inputs.objects) {
    if (object->turned_to_rest <= kTipsOver) continue;
    warnings.push_back(object->id + " tips over by " +
                       FormatFixed(DegFromRad(object->turned_to_rest), 0) +
                       " deg when it is set down as its mesh lies; it is grasped as it rests");
  }
  return warnings;
}

}  // namespace graspbench
