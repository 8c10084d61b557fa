#pragma once
/** @file
A foreign grasp as a hand of graspbench has it: poses of its frame H in the object and a position for
each of its joints, by names. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/closing_table.h"
#include "core/hand/hand.h"
#include "datasets/grasps/grasp_files.h"

namespace graspbench {

struct HandStage {
  std::string name;
  Pose X_OH;          ///< O: the object as its scaled mesh is drawn [m]
  Eigen::VectorXd q;  ///< of all joints [rad], [m]; may lie outside the joints' limits
};

struct HandGrasp {
  std::vector<HandStage> stages;
  /** Of a gripper of MultiGripperGrasp's tables (multigripper_table.h). Its signs hold for the
  hand's joints; where the hand lacks one of its links, all the hand's links count. */
  std::optional<ClosingTable> table;
  std::vector<std::string> assumptions;  ///< those of the file, then those of the mapping
};

/** Joints are found by their names; a hand may put a prefix before them: "rh_FFJ4" is "FFJ4". What
DexGraspNet calls robot0:FFJ3 is FFJ4 of a hand with the maker's names.

Joints that the file does not state: coupled ones follow their coupling, those of the wrist are at
0; both are noted. Others are an error. Coupled joints that the file states are taken as stated: q
need not obey the hand's coupling.

@throws Error(kFormat) naming joints or links that the hand or the file does not have, and, for
DexGraspBench, a hand whose joints lie more than 1 mm from those of the hand that the format means.
*/
HandGrasp MapToHand(const ForeignGrasp& grasp, const Hand& hand);

/** The Shadow Hand as the formats of DexGraspBench and DexGraspNet have it.

The 22 joints behind the root's pose in DexGraspBench's rows of 29 numbers, by the maker's
names: FF MF RF J4..J1, LF J5..J1, TH J5..J1. */
const std::vector<std::string>& ListDexgraspbenchJoints();

/** A joint of DexGraspNet's hand and the maker's joint that it is. Its model counts from 0 where
the maker counts from 1, and turns four of them the other way round. */
struct DexgraspnetJoint {
  std::string name;   ///< "robot0:FFJ3"
  std::string maker;  ///< "FFJ4"
  double sign = 1.0;  ///< of the maker's position for a positive one here
};
/** In the order of its files. Source: axes and ranges of shadow_hand_wrist_free.xml of
PKU-EPIC/DexGraspNet against those of the maker's description. */
const std::vector<DexgraspnetJoint>& ListDexgraspnetJoints();

/** How far the centres of a hand's joints lie from those of the Shadow Hand in MuJoCo Menagerie,
which DexGraspBench grasps with: the largest distance over two postures, all joints at 0 and all at
0.3 rad, with the palms laid upon each other [m].
@pre the hand has all joints of ListDexgraspbenchJoints. @param joints  their indices in the hand */
double CalcShadowDifference(const Hand& hand, const std::vector<int>& joints);

}  // namespace graspbench
