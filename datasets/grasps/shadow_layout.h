#pragma once
/** @file
The Shadow Hand as the formats of DexGraspBench and DexGraspNet have it. */

#include <string>
#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

/** The 22 joints behind the root's pose in DexGraspBench's rows of 29 numbers, by the maker's
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
