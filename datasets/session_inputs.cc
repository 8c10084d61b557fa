#include "datasets/session_inputs.h"

#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

const std::vector<std::string> kAll = {"all"};

}  // namespace

SessionInputs LoadSessionInputs(const SessionConfig& config) {
  SessionInputs inputs;
  for (const std::string& name : config.hands == kAll ? ListHands() : config.hands) {
    auto hand = std::make_shared<const Hand>(LoadHand(name));
    std::vector<StandardGrasp> grasps = LoadStandardGrasps(*hand);
    inputs.hands.push_back({std::move(hand), std::move(grasps)});
  }
  for (const std::string& name : config.objects == kAll ? ListObjects() : config.objects) {
    inputs.objects.push_back(LoadObject(name));
  }
  return inputs;
}

}  // namespace graspbench
