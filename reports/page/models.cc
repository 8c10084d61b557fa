#include "reports/page/models.h"

#include "core/base/error.h"
#include "core/grasp/standard_grasp.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

template <class T>
std::shared_ptr<const T> FindIn(const std::map<std::string, std::shared_ptr<const T>>& models,
                                const std::string& id) {
  const auto found = models.find(id);
  return found == models.end() ? nullptr : found->second;
}

/** Adds the shipped grasp types when the camera chooses and the session has none of its own. */
void AddShippedTypes(const SessionConfig& config, const SessionInputs& inputs,
                     RehearsedTypes& types) {
  if (!HasGraspBySight(config)) return;
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      const auto type =
          FindShippedType(MakeRehearsalTask(config, {}, hand.hand, hand.grasps, object));
      if (type) types.emplace(std::pair(hand.hand->id, object->id), *type);
    }
  }
}

}  // namespace

std::shared_ptr<const Hand> SessionModels::FindHand(const std::string& id) const {
  return FindIn(hands, id);
}

std::shared_ptr<const GraspObject> SessionModels::FindObject(const std::string& id) const {
  return FindIn(objects, id);
}

std::string SessionModels::NameOfHand(const std::string& id) const {
  const auto hand = FindHand(id);
  return hand ? hand->name : id;
}

std::string SessionModels::NameOfObject(const std::string& id) const {
  const auto object = FindObject(id);
  return object ? object->name : id;
}

std::string SessionModels::NameOfDigit(const std::string& hand_id, const std::string& digit) const {
  if (const auto hand = FindHand(hand_id)) {
    for (const Digit& known : hand->digits) {
      if (known.id == digit) return known.name;
    }
  }
  return digit;
}

SessionModels LoadSessionModels(const SessionConfig& config, const std::filesystem::path& folder,
                                const std::vector<PlannedTrial>& plan) {
  SessionModels models;
  try {
    const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater, folder);
    for (const SessionHand& hand : inputs.hands) models.hands[hand.hand->id] = hand.hand;
    for (const auto& object : inputs.objects) models.objects[object->id] = object;
    models.types = inputs.types;
    AddShippedTypes(config, inputs, models.types);
    if (!plan.empty() && !(MakePlan(config, inputs) == plan)) {
      models.problems.push_back(
          "a hand, an object, a grasp or the physics has changed since the session was planned; "
          "names, pictures and tables show the present state");
    }
  } catch (const Error& e) {
    models.problems.push_back(e.what());
  }
  return models;
}

std::string NameOfGrasp(const std::string& id) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == id) return taxon.name + " (" + id + ")";
  }
  return id;
}

std::string NameOfCell(const CellSummary& cell, const SessionModels& models) {
  return models.NameOfHand(cell.hand) + ", " + models.NameOfObject(cell.object) + ", " +
         NameOfGrasp(cell.grasp);
}

}  // namespace graspbench
