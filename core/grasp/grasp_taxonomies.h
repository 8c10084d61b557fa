#pragma once
/** @file
What the four grasp types are called in seven earlier taxonomies (Roethling 2007, chapter 2): names
of hand postures of people, so a relation, no equality. */

#include <array>
#include <vector>

#include "core/grasp/standard_grasp.h"

namespace graspbench {

struct GraspTaxonomy {
  const char* author;
  int year;
  /** By GraspType: all finger precision, two finger precision, power, two finger pinch; "-": it has
  no such grasp. */
  std::array<const char*, 4> names;
};

inline constexpr GraspType kGraspTypes[] = {GraspType::kAllFingerPrecision,
                                            GraspType::kTwoFingerPrecision, GraspType::kPower,
                                            GraspType::kTwoFingerPinch};

/** By year. */
const std::vector<GraspTaxonomy>& ListGraspTaxonomies();

/** "t1" to "t4". */
const char* CodeOf(GraspType type);
const char* NameOf(GraspType type);  ///< "all finger precision"

}  // namespace graspbench
