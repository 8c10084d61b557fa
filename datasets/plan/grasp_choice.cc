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

/** By what the object names, else by geometry (predict_grasp.h). */
const Grasp& PredictBestGrasp(const SessionInputs& inputs, const SessionHand& hand,
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

const Grasp& ChooseGrasp(const std::string& name, const SessionInputs& inputs,
                         const SessionHand& hand,
                         const std::shared_ptr<const GraspObject>& object) {
  const auto type = inputs.types.find({hand.hand->id, object->id});
  if (name == kBestGrasp && type != inputs.types.end()) {
    if (const Grasp* grasp = FindGrasp(hand, *object, type->second.grasp)) return *grasp;
  }
  return PredictBestGrasp(inputs, hand, object);
}

bool IsChosen(const std::string& name) { return name == kBestGrasp || name == kPredictedGrasp; }

/** Under a condition the one that the base chooses; null: the hand does not have it here. */
const Grasp* FindChosenGrasp(const std::string& name, const SessionInputs& inputs,
                             const SessionHand& hand,
                             const std::shared_ptr<const GraspObject>& object) {
  if (!inputs.base) return &ChooseGrasp(name, inputs, hand, object);
  const SessionInputs& base = *inputs.base;
  const auto base_hand =
      std::find_if(base.hands.begin(), base.hands.end(),
                   [&](const SessionHand& one) { return one.hand->id == hand.hand->id; });
  const auto base_object = std::find_if(base.objects.begin(), base.objects.end(),
                                        [&](const auto& one) { return one->id == object->id; });
  GRASPBENCH_DEMAND(base_hand != base.hands.end() && base_object != base.objects.end(),
                    hand.hand->id + ", " + object->id);
  return FindGrasp(hand, *object, ChooseGrasp(name, base, *base_hand, *base_object).id);
}

bool HasHeld(const SessionInputs& inputs, const SessionHand& hand, const GraspObject& object) {
  const auto type = inputs.types.find({hand.hand->id, object.id});
  return type != inputs.types.end() && type->second.held > 0;
}

/** What each name of the session stands for on an object: one grasp, all those of which the camera
chooses, those that "best" and "predicted" are chosen of, or "all". Left out is what the object
names or an imagined trial held. */
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
    } else if (!IsChosen(name)) {
      add(FindGrasp(hand, *object, ResolveGraspName(inputs, name)));
    } else if (object->best_grasp.count(hand.hand->id) == 0 &&
               !(name == kBestGrasp && HasHeld(inputs, hand, *object))) {
      for (const std::string& id : object->grasp_order) add(FindGrasp(hand, *object, id));
    }
    if (!group.empty()) tried.push_back(std::move(group));
  }
  return tried;
}

/** The sentence of ListObjectWarnings; empty: one of the grasps reaches the object. */
std::string DescribeMiss(const SessionInputs& inputs, const SessionHand& hand,
                         const std::shared_ptr<const GraspObject>& object,
                         const std::vector<const Grasp*>& tried) {
  const FittedGrasp* nearest = nullptr;
  std::string ids;
  for (const Grasp* grasp : tried) {
    if (grasp->placement) return "";
    const FittedGrasp& fitted = inputs.fitted->Find(hand.hand, *grasp, object);
    if (fitted.prediction.reaches()) return "";
    ids += (ids.empty() ? "" : ", ") + grasp->id;
    if (!nearest || fitted.prediction.reach_miss < nearest->prediction.reach_miss) {
      nearest = &fitted;
    }
  }
  const auto format = [](double length) { return FormatFixed(MmFromM(length), 1) + " mm"; };
  const bool is_one = tried.size() == 1;
  const double width = std::min(object->size.x(), object->size.y());
  const double opening = CalcPreGraspWidth(*hand.hand, nearest->grasp);
  return hand.hand->id + ", " + object->id + ": " +
         (is_one ? ids + " does not reach it" : "none of " + ids + " reaches it") +
         ", so every trial will be unreachable; " +
         (is_one ? "its" : "nearest is " + nearest->grasp.id + ", whose") + " pads stop " +
         format(nearest->prediction.reach_miss) + " short" +
         (opening > 0.0 && width > opening
              ? ": it is " + format(width) + " wide, and they open to " + format(opening)
              : "");
}

/** What imagined trials say of the session's rehearsed and best grasps. */
std::vector<std::string> ListDoubtfulTypes(const SessionConfig& config,
                                           const SessionInputs& inputs) {
  std::vector<std::string> warnings = inputs.doubts;
  if (std::count(config.grasps.begin(), config.grasps.end(), kBestGrasp) == 0) return warnings;
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      const auto found = inputs.types.find({hand.hand->id, object->id});
      if (found == inputs.types.end()) continue;
      const RehearsedType& type = found->second;
      const std::string doubt =
          DescribeDoubt(type.hand, type.object, type.grasp, type.held, type.draws);
      if (!doubt.empty()) warnings.push_back(doubt);
    }
  }
  return warnings;
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
    const Grasp* grasp = IsChosen(name) ? FindChosenGrasp(name, inputs, hand, object)
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
  std::vector<std::string> warnings = ListDoubtfulTypes(config, inputs);
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      for (const auto& tried : ListTried(config, inputs, hand, object)) {
        const std::string miss = DescribeMiss(inputs, hand, object, tried);
        if (!miss.empty()) warnings.push_back(miss);
      }
    }
  }
  for (const auto& object : inputs.objects) {
    if (object->turned_to_rest <= kTipsOver) continue;
    warnings.push_back(
        object->id + " tips over by " + FormatFixed(DegFromRad(object->turned_to_rest), 0) +
        " deg when it is placed in the orientation of its mesh; it is grasped in its resting pose");
  }
  return warnings;
}

}  // namespace graspbench
