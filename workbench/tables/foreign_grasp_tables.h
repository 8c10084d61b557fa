#pragma once
/** @file
What files of grasps that others made hold, for people and as JSON. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/hand/hand.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/judged_grasps/grasp_store.h"

namespace graspbench {

/** A grasp that the hand cannot take, and why. */
struct UnmappedGrasp {
  std::string name;  ///< "a.npy, grasp 3"
  std::string reason;
};

/** Tries every grasp on the hand. */
std::vector<UnmappedGrasp> FindUnmapped(const std::vector<ForeignGrasp>& grasps, const Hand& hand);

/** Counts by format, object and stages; ranges; labels; then assumptions, and every file that could
not be read. */
std::string FormatGraspCollection(const GraspCollection& collection);
/** All grasps, with their poses and joints. */
Json MakeJson(const GraspCollection& collection);

/** What judged grasps say, a line a profile, for people and as JSON. */
std::string FormatJudged(const JudgedSummary& summary);
Json MakeJson(const JudgedSummary& summary);

}  // namespace graspbench
