#pragma once
/** @file
Maps a foreign grasp to a hand of graspbench: poses of its frame H in the object and a position of
each of its joints, matched by name. */

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
  Pose X_OH;          ///< O: frame of the object's scaled mesh [m]
  Eigen::VectorXd q;  ///< of all joints [rad], [m]; may exceed the joints' limits
};

struct HandGrasp {
  std::vector<HandStage> stages;
  /** For a gripper in MultiGripperGrasp's tables (multigripper_table.h), with signs for the hand's
  joints. If the hand lacks one of its contact links, all links of the hand count. */
  std::optional<ClosingTable> table;
  std::vector<std::string> assumptions;  ///< of the file, then of the mapping
};

/** Maps a grasp to the hand. Joints are matched by name; a hand's names may have a prefix:
"rh_FFJ4" matches "FFJ4". DexGraspNet's "robot0:FFJ3" is FFJ4 of a hand with the maker's names.

If the file does not state a joint, a coupled joint follows its coupling and a wrist joint is at 0;
both are listed as assumptions. Other missing joints are an error. Coupled joints in the file are
used as stated, so q need not obey the hand's coupling.

@throws Error(kFormat) naming joints or links that the hand or the file lacks, or, for
DexGraspBench, a hand whose joint centres differ by more than 1 mm from those of the format's
hand. */
HandGrasp MapToHand(const ForeignGrasp& grasp, const Hand& hand);

/** The 22 joints that follow the root's pose in DexGraspBench's rows of 29 numbers, by the maker's
names for the Shadow Hand: FF MF RF J4..J1, LF J5..J1, TH J5..J1. */
const std::vector<std::string>& ListDexgraspbenchJoints();

/** A joint of DexGraspNet's Shadow Hand and the corresponding joint of the maker. DexGraspNet's
model counts joints from 0 where the maker counts from 1, and inverts four of them. */
struct DexgraspnetJoint {
  std::string name;   ///< "robot0:FFJ3"
  std::string maker;  ///< "FFJ4"
  double sign = 1.0;  ///< maker's position = sign * this position
};
/** The joints in the order of DexGraspNet's files. Source: axes and ranges in
shadow_hand_wrist_free.xml of PKU-EPIC/DexGraspNet, compared with the maker's description. */
const std::vector<DexgraspnetJoint>& ListDexgraspnetJoints();

/** Largest distance between the joint centres of a hand and of the Shadow Hand in MuJoCo Menagerie,
which DexGraspBench uses [m]. It is taken over two postures, all joints at 0 and all at 0.3 rad,
with the palms aligned.
@pre the hand has all joints of ListDexgraspbenchJoints. @param joints  their indices in the hand */
double CalcShadowDifference(const Hand& hand, const std::vector<int>& joints);

}  // namespace graspbench
