#pragma once
/** @file
Definition of each standard grasp: which digits grasp, by which opposition, which parts bear the
load, for which objects. `hand develop`, `hand check`, the choice by prediction and reports use this
table.

Digits and oppositions of g1 to g4 are those of Roethling (2007, section 2.3.2). Precision grasps
touch with the pads. Two finger precision uses the thumb and the index finger only. In power grasps
all fingers envelop the object and the palm bears load. The pinch is Iberall's side opposition,
"either between the thumb pad and the side of the index finger, or else between the sides of the
fingers". g5 was made for one object. g6, the enclosing grasp without the palm, and all widths are
proposed by graspbench. */

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
  const char* bears;                     ///< the parts that bear the load, for reports
  double least_width_mm, most_width_mm;  ///< range of object widths
  const char* object;                    ///< id of the only object that it is for; "": any
};
/** In the order of ListGraspTaxa(). */
const std::vector<GraspTypeRule>& ListGraspTypeRules();
/** Returns null for a grasp that is not a standard grasp. */
const GraspTypeRule* FindGraspTypeRule(const std::string& grasp);

/** "all digits", "thumb and index", "two digits", "three digits". */
const char* NameOf(TypeDigits digits);
/** Id of the index finger: the digit of that name, otherwise the first that is not the thumb. Empty
for a hand of one digit. */
std::string FindIndexFinger(const Hand& hand);
/** Deviations of a standard grasp from its type, one sentence each: by its digits, or because fewer
than half of the objects held in its development were held with the opposition of its type. */
std::vector<std::string> ListTypeFaults(const Hand& hand, const Grasp& grasp);

/** Whether a choice by prediction may select this grasp for this object: a grasp that seeks the
palm is for the widths of its type only. */
bool IsGraspFor(const Grasp& grasp, const GraspObject& object);

/** Whether an object was held with the opposition of the grasp's type and, for pad opposition, all
grasping digits touched before lift-off. False if it was not held. */
bool IsAsCalled(const std::string& grasp, const TrialResult& result);

}  // namespace graspbench
