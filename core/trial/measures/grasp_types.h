#pragma once
/** @file
What each standard grasp is by its name: which digits take, which opposition holds, which parts
bear, for which objects. One table for `hand develop`, `hand check`, the choice by prediction and
reports.

Digits and oppositions of g1 to g4 are those of Roethling (2007, section 2.3.2): precision touches
with the pads; two finger precision is executed by the thumb and the index finger alone; in power
all fingers envelop the object and the palm bears; the pinch is Iberall's side opposition, "either
between the thumb pad and the side of the index finger, or else between the sides of the fingers".
g5 was made for one object. g6, the envelope without the palm, and all widths are proposed by
graspbench. */

#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/measures/opposition.h"
#include "core/trial/trial_result.h"

namespace graspbench {

enum class TypeDigits { kAll, kThumbAndIndex, kAnyTwo, kAnyThree };

struct GraspTypeRule {
  const char* grasp;  ///< "g1".. "g6"
  TypeDigits digits;
  Opposition opposition;
  const char* bears;                     ///< the parts, for people
  double least_width_mm, most_width_mm;  ///< of objects that it is for
  const char* object;                    ///< id of the only object that it is for; "": any
};
/** In the order of ListGraspTaxa(). */
const std::vector<GraspTypeRule>& ListGraspTypeRules();
/** Null for a grasp that is no standard one. */
const GraspTypeRule* FindGraspTypeRule(const std::string& grasp);

/** "all digits", "thumb and index", "two digits", "three digits". */
const char* NameOf(TypeDigits digits);
/** The index finger: the digit of that name; without one, the first that is not the thumb. Empty for
a hand of one digit. */
std::string FindIndexFinger(const Hand& hand);
/** Where a standard grasp is not what it is called, by its digits or by less than half of what its
development held: one sentence each. */
std::vector<std::string> ListTypeFaults(const Hand& hand, const Grasp& grasp);

/** Whether a choice by prediction may take this grasp for this object: one that seeks the palm is
for the widths of its name. */
bool IsGraspFor(const Grasp& grasp, const GraspObject& object);

/** Of a held object: its opposition is the one of its name and, by pads, all grasping digits touched
before lift-off. False when it was not held. */
bool IsAsCalled(const std::string& grasp, const TrialResult& result);

}  // namespace graspbench
