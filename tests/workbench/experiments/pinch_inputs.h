#pragma once
/** @file
Grasps of a block by two balls (core/physics/known_answers/small_scenes.h) as if read from a file:
the first holds, the second presses with a tenth of that, the third closes beside the block. */

#include "core/physics/known_answers/small_scenes.h"
#include "datasets/judged_grasps/profile_file.h"
#include "workbench/experiments/grasp_inputs.h"

namespace graspbench {

inline GraspInputs MakePinchInputs() {
  GraspInputs inputs;
  auto hand = std::make_shared<Hand>(MakeSqueezeHand(2, 0.03, 1.0, 0.0));
  hand->id = "pinch";
  for (HandJoint& joint : hand->joints) joint.drive = {20.0, 0.2, 10.0};
  inputs.hand = hand;
  inputs.is_asked = {true, true};
  auto block = std::make_shared<GraspObject>(MakeBlock(0.1));
  block->id = "block";
  const std::pair<double, double> grasps[] = {{0.0255, 0.0}, {0.00255, 0.0}, {0.0255, 0.2}};
  for (const auto& [squeeze, aside] : grasps) {
    GraspInput input;
    input.grasp.source = "pinch.npy";
    input.grasp.index = static_cast<int>(inputs.grasps.size());
    input.grasp.object = "block";
    input.grasp.label = squeeze > 0.01;
    input.object = block;
    for (const double share : {0.0, 0.5, 1.0}) {
      input.stages.push_back({share == 0.0   ? "pregrasp"
                              : share == 0.5 ? "grasp"
                                             : "squeeze",
                              MakePose(Eigen::Vector3d(0.0, aside, kSqueezeLever)),
                              Eigen::VectorXd::Constant(2, share * squeeze)});
    }
    inputs.grasps.push_back(input);
  }
  inputs.description = {{"hand", "pinch"}};
  return inputs;
}

/** Bare surfaces, friction 0.5: 5 N a finger stand 5 N, half a newton 0.5 N; a push is 1 N. */
inline FreeSpaceProfile MakePinchProfile() {
  FreeSpaceProfile profile;
  profile.name = "pinch";
  profile.surfaces.pads = "given";
  profile.surfaces.torsion_radius = 0.02;
  profile.drives.beyond_limits = "ignore";
  profile.acceleration = 10.0;
  profile.test_time = 0.4;
  profile.stage_time = 0.1;
  profile.sim.gravity = 0.0;
  return profile;
}

}  // namespace graspbench
