#pragma once
/** @file
How far a hand is open, as one number from the tips of its digits: the family.

With p_T the thumb's tip, p_k the n - 1 others and c the mean of all n:

    aperture        |p_T - p_I|                     thumb and index; the usual "grip aperture"
    virtual_finger  |p_T - mean p_k|                default (Arbib 1985; Gilster et al. 2012)
    thumb_finger    mean of |p_T - p_k|
    rms_radius      sqrt(mean of |p_i - c|^2)       over all digits
    centroid_sum    sum of |p_i - c|                over all digits
    fan             sqrt(area of the triangles c p_i p_i+1)      thumb round to thumb (Supuk 2005)
    perimeter       sum of |p_i - p_i+1|            thumb round to thumb
    outer_triangle  sqrt(area of the triangle of thumb, index and last digit)
    hull            cube root of the volume of the convex hull of four or five tips

The hull of five tips is triangulated in two ways, which together use each of the five tetrahedra of
four tips once (Radon's theorem): its volume is half the sum of theirs.

All are lengths [m]. With two digits the first three are equal. A measure over "all" digits takes
the digits given, so compare only like with like. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "human_study/events/filtered_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct HandOpening {
  const char* id;
  const char* text;
  /** @param tips  one column per digit, thumb first, then from radial to ulnar. */
  double (*calc)(const Eigen::Matrix3Xd& tips);
  int min_digits;  ///< with fewer every sample is invalid; at most five take part
};

inline constexpr const char* kDefaultHandOpening = "virtual_finger";

const std::vector<HandOpening>& HandOpeningList();
/** @throws Error(kNotFound) with a suggestion. */
const HandOpening& FindHandOpening(const std::string& id);

/** Over a trial, with the tips filtered at `cutoff` [Hz]. A sample without one of the digits is
invalid: leaving it out would change what is measured.
@param left_out  a digit to leave out ("RF"), for leave-one-digit-out reliability; empty: none. */
ScalarCurve CalcOpeningCurve(FilteredTrial& trial, const HandOpening& opening, double cutoff,
                             const std::string& left_out = "");

/** When the hand was widest. Normal people's openings have bumps and plateaus (Bongers, Zaal and
Jeannerod 2012); the *largest* maximum and the *last* one before contact then differ, and with them
the closure time. Both are found; which one is used must be said. */
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
