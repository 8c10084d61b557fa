#pragma once
/** @file
An arm at its place with a hand on its flange. */

#include <memory>
#include <string>
#include <vector>

#include "core/arm/arm.h"
#include "core/arm/arm_config.h"
#include "core/base/text/json.h"
#include "core/hand/hand.h"

namespace graspbench {

struct MountedArm {
  std::shared_ptr<const Arm> arm;
  Pose X_WB = Pose::Identity();  ///< base in the world
  Pose X_FH = Pose::Identity();  ///< hand in the flange
};

/** Names of ArmConfig::mount: x, -x, .. -z. */
std::vector<std::string> ListMounts();

/** The hand's axis `mount` lies along the flange's z, and the hindmost contact surface of the hand's
root along it touches the flange. Rotated about z by the shortest way.
@pre config.mount is one of ListMounts(). */
MountedArm MountArm(const ArmConfig& config, std::shared_ptr<const Arm> arm, const Hand& hand);

/** All that decides what the arm does, for ids: its hash and both poses. */
Json DescribeArm(const MountedArm& arm);

}  // namespace graspbench
