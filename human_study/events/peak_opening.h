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

/** Maxima of a filtered opening between `begin` and `end` [s], refined by a parabola through three
samples. A last maximum counts when it rises at least `min_prominence` [m] above the valley between
it and the largest.
@param noise  SD of the filtered opening's rate of change [m/s]: over the curvature at the peak it
is the uncertainty of its time. */
PeakOpening FindPeakOpening(const ScalarCurve& opening, double begin, double end,
                            double min_prominence, double noise);

}  // namespace graspbench
