#pragma once
/** @file
Dependence of the grasp closure time on the definition of its end. Closure begins at the widest hand
opening, t0. Definitions of the end in use:

    contact  the last digit's first contact: GCT (core/grasp/contact_timing.h)
    object   the object first leaves its place, in any direction
    speed    from here on no visible fingertip is fast relative to the object: the start of the hold

Each row covers the included trials with both t0 and this end, so that n differs. Negative times, as
for an object that is pushed before the widest opening, are kept. */

#include <vector>

#include "core/base/units.h"

namespace graspbench {

struct StudyTrial;

struct ClosureEnd {
  const char* id;    ///< "contact"
  const char* text;  ///< for tables
  int num_trials = 0;
  double lower_quartile = kUnset, median = kUnset, upper_quartile = kUnset;  ///< end - t0 [s]
  double median_after_contact = kUnset;  ///< of end - last contact [s]; 0 for contact
};

/** Lists the ends in the order above. @param trials  removed ones are ignored. */
std::vector<ClosureEnd> ListClosureEnds(const std::vector<StudyTrial>& trials);

}  // namespace graspbench
