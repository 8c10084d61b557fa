#include "datasets/plan/session_inputs.h"

#include "core/base/config.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/input_copies.h"

namespace graspbench {
namespace {

const std::vector<std::string> kAll = {"all"};

/** @returns the grasp's id. */
std::string AddGraspFile(const std::string& path, SessionInputs& inputs) {
  std::vector<const Hand*> hands;
  for (const SessionHand& hand : inputs.hands) hands.push_back(hand.hand.get());
  const GraspFile file = LoadGraspFile(path, hands);
  for (SessionHand& hand : inputs.hands) {
    if (hand.hand->id == file.hand) hand.grasps.push_back(file.grasp);
  }
  return file.grasp.id;
}

/** The session's word comes before the objects' and the grasps'. */
void ApplyApproach(const std::string& name, SessionInputs& inputs) {
  const ApproachRow* row = FindRow(kApproaches, name);
  if (!row || row->value == Approach::kAutomatic)
    return;  // an unknown one is refused with the rest
  const Approach approach = row->value;
  for (SessionHand& hand : inputs.hands) {
    for (Grasp& grasp : hand.grasps) {
      if (!grasp.placement) grasp.approach = approach;
    }
  }
  for (auto& object : inputs.objects) {
    auto changed = std::make_shared<GraspObject>(*object);
    changed->approach = approach;
    object = std::move(changed);
  }
}

}  // namespace

namespace {

/** All that decides what hands and objects are. */
Json DescribeInputs(const SessionConfig& config) {
  return Json{ConfigToJson(config.model), ConfigToJson(config.imperfections), config.approach};
}

SessionInputs LoadBaseInputs(const SessionConfig& config, FieldUse field_use,
                             const std::filesystem::path& folder) {
  SessionInputs inputs;
  for (const std::string& name : config.hands == kAll ? ListHands() : config.hands) {
    auto hand = std::make_shared<Hand>(LoadHand(FindHandInput(name, folder)));
    ApplyModel(config.model, *hand);
    ApplyImperfections(config.imperfections, *hand);
    std::vector<Grasp> grasps = LoadStandardGrasps(*hand);
    inputs.hands.push_back({std::move(hand), std::move(grasps)});
  }
  for (const std::string& name : config.objects == kAll ? ListObjects() : config.objects) {
    auto object =
        std::make_shared<GraspObject>(*LoadObject(FindObjectInput(name, folder), field_use));
    ApplyModel(config.model, *object);
    inputs.objects.push_back(std::move(object));
  }
  for (size_t i = 0; i < config.grasps.size(); ++i) {
    const std::string& name = config.grasps[i];
    if (IsGraspFile(name)) {
      inputs.grasp_files[name] = AddGraspFile(FindGraspInput(name, i, folder), inputs);
    }
    for (const std::string& path : ListSceneGrasps(name, folder)) AddGraspFile(path, inputs);
  }
  ApplyApproach(config.approach, inputs);
  return inputs;
}

}  // namespace

SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use,
                                const std::filesystem::path& folder) {
  SessionInputs inputs = LoadBaseInputs(config, field_use, folder);
  const std::shared_ptr<const SessionInputs> base = std::make_shared<SessionInputs>(inputs);
  std::map<std::string, std::shared_ptr<const SessionInputs>> known = {
      {FormatJson(DescribeInputs(config)), base}};
  for (const Condition& condition : config.conditions) {
    ConditionInputs made = ApplyCondition(condition, config);
    std::shared_ptr<const SessionInputs>& shared = known[FormatJson(DescribeInputs(made.config))];
    if (!shared) {
      SessionInputs changed = LoadBaseInputs(made.config, field_use, folder);
      changed.base = base;
      shared = std::make_shared<SessionInputs>(std::move(changed));
    }
    made.inputs = shared;
    inputs.conditions.emplace(condition.name, std::move(made));
  }
  return inputs;
}

}  // namespace graspbench
