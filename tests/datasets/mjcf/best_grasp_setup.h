#pragma once
/** @file
A trial of an object's best grasp without variation. */

#include <memory>
#include <string>

#include "core/hand/load_hand.h"
#include "core/trial/trial_setup.h"
#include "objects/catalogue.h"

namespace graspbench {

inline TrialSetup MakeBestGraspSetup(const std::string& hand_id, const std::string& object_id) {
  TrialSetup setup;
  const auto hand = std::make_shared<const Hand>(LoadHand(hand_id));
  setup.hand = hand;
  setup.object = LoadObject(object_id);
  for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
    if (grasp.id == setup.object->best_grasp.at(hand_id)) setup.grasp = grasp;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(hand->num_joints());
  return setup;
}

}  // namespace graspbench
