#pragma once
/** @file
Content of grasp files made by others, as text and as JSON. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/hand/hand.h"
#include "datasets/grasps/grasp_files.h"
#include "datasets/judged_grasps/grasp_store.h"

namespace graspbench {

/** A grasp that cannot be mapped onto the hand, and why. */
struct UnmappedGrasp {
  std::string name;  ///< "a.npy, grasp 3"
  std::string reason;
};

/** Returns the grasps that cannot be mapped onto the hand. */
std::vector<UnmappedGrasp> FindUnmapped(const std::vector<ForeignGrasp>& grasps, const Hand& hand);

/** Counts by format, object and stages; value ranges; labels; then assumptions, and every file that
could not be read. */
std::string FormatGraspCollection(const GraspCollection& collection);
/** All grasps, with poses and joint positions. */
Json MakeJson(const GraspCollection& collection);

/** Verdicts on judged grasps, one row per profile, as text and as JSON. */
std::string FormatJudged(const JudgedSummary& summary);
Json MakeJson(const JudgedSummary& summary);

}  // namespace graspbench
