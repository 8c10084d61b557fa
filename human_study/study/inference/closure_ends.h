#pragma once
/** @file
How the grasp closure time depends on what ends the closure. It begins at the widest hand opening,
t0; ends that are in use:

    contact  the last digit's first contact: GCT (core/grasp/contact_timing.h)
    object   the object first leaves its place, in any direction
    speed    from here on no visible fingertip is fast against the object: the begin of the hold

Over the included trials and have both t0 and this end, so that each row has its own n. A negative
time, as of an object that is pushed before the widest opening, stays what it is. */

#include <vector>

#include "core/base/units.h"

namespace graspbench {

struct StudyTrial;

struct ClosureEnd {
  const char* id;    ///< "contact"
  const char* text;  ///< for tables
  int num_trials = 0;
  double lower_quartile = kUnset, median = kUnset, upper_quartile = kUnset;  ///< end less t0 [s]
  double median_after_contact = kUnset;  ///< of the end less the last contact [s]; 0 for contact
};

/** In the order above. @param trials  those removed are left out. */
std::vector<ClosureEnd> ListClosureEnds(const std::vector<StudyTrial>& trials);

}  // namespace graspbench
