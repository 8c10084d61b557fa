#pragma once
/** @file
When the hand was widest. Normal people's openings have bumps and plateaus (Bongers, Zaal and
Jeannerod 2012); the *largest* maximum and the *last* one before contact then differ, and with them
the closure time. Both are found; which one is used must be said. */

#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct PeakOpening {
  EventTime largest;
  double largest_value = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  EventTime last;
  double last_value = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  bool is_ambiguous = false;                                     ///< they are different maxima
};

/** Maxima of a filtered opening, refined by a parabola through three samples. The largest is looked
for between `begin` and `end`, the last one between `begin` and `first_contact` (NaN: `end`). A last
maximum counts when it rises at least `min_prominence` [m] above the valley before it.

Uncertainty of the time: noise of the rate of change over the curvature at the peak, and sampling.
*/
PeakOpening FindPeakOpening(const ScalarCurve& opening, double begin, double first_contact,
                            double end, double min_prominence);

}  // namespace graspbench
