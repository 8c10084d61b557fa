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

/** The base in the world. */
Pose CalcArmBase(const ArmConfig& config);

/** Names of ArmConfig::mount: x, -x, .. -z. */
std::vector<std::string> ListMounts();

/** The hand's axis `mount` lies along the flange's z; H is turned there by the shortest way. The
hindmost point of the hand's root along this axis touches the flange: of its pictures, or where it
has none of its contact surface.
@pre config.mount is one of ListMounts(). */
MountedArm MountArm(const ArmConfig& config, std::shared_ptr<const Arm> arm, const Hand& hand);

/** In its link's frame. */
TriMesh MakeCapsuleMesh(const ArmCapsule& capsule);
/** Of every arm in pictures and scenes, linear RGB. */
inline const Eigen::Vector3f kArmColour(0.55f, 0.56f, 0.58f);

/** "base at -0.500, 0.000, 0.000 m, turned by 0.0 deg". */
std::string DescribeArmBase(const Pose& X_WB);
/** "PUMA 560 (puma560), base at .." */
std::string DescribeArmPlace(const MountedArm& arm);

/** All that decides what the arm does, for ids: its hash, both poses, where a trial starts. */
Json DescribeArm(const MountedArm& arm);

}  // namespace graspbench
