#include "datasets/session/session_inputs.h"

#include <string_view>

#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

const std::vector<std::string> kAll = {"all"};

bool IsGraspFile(const std::string& name) {
  constexpr std::string_view kEnding = ".yaml";
  return name.size() > kEnding.size() &&
         name.compare(name.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

void AddGraspFile(const std::string& path, SessionInputs& inputs) {
  std::vector<const Hand*> hands;
  for (const SessionHand& hand : inputs.hands) hands.push_back(hand.hand.get());
  GraspFile file = LoadGraspFile(path, hands);
  inputs.grasp_files[path] = file.grasp.id;
  for (SessionHand& hand : inputs.hands) {
    if (hand.hand->id == file.hand) hand.grasps.push_back(std::move(file.grasp));
  }
}

}  // namespace

SessionInputs LoadSessionInputs(const SessionConfig& config, FieldUse field_use) {
  SessionInputs inputs;
  for (const std::string& name : config.hands == kAll ? ListHands() : config.hands) {
    auto hand = std::make_shared<const Hand>(LoadHand(name));
    std::vector<StandardGrasp> grasps = LoadStandardGrasps(*hand);
    inputs.hands.push_back({std::move(hand), std::move(grasps)});
  }
  for (const std::string& name : config.objects == kAll ? ListObjects() : config.objects) {
    inputs.objects.push_back(LoadObject(name, field_use));
  }
  for (const std::string& name : config.grasps) {
    if (IsGraspFile(name)) AddGraspFile(name, inputs);
  }
  return inputs;
}

}  // namespace graspbench
