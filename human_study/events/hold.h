#pragma once
/** @file
When the hand holds the object. Contacts are looked for backwards from there, so that touching and
letting go before the grasp does not count.

An object that is lifted tells it: at its lift-off it is in the hand (lift_off.h). Where nothing is
lifted, or the object was not recorded, the hand must tell. A grasp then is where the hand rests at
the object, closed: three criteria, each a number between 0 and 1 at every sample, combined by a
rule. This is the way of Schot, Brenner and Smeets (2010): a speed threshold alone takes every pause
for the grasp, a place alone every passage.

    slow    of the fastest visible tip against the object: 1 at rest, 0 from the threshold on,
            linear between. The threshold is the usual 50 mm/s, or four standard deviations of the
            noise of that speed where this is more.
    there   of the wrist's distance from the object (else from where it began): 1 where it is
            nearest the object (farthest from the beginning), 0 for the half of the range away from
            there, linear between
    closed  of the hand's opening: 1 at its smallest, 0 at its widest, linear

No threshold of distance or opening has to be chosen: both criteria are relative to the trial.
Hidden tips take no part in `slow`, which is 0 where none is seen; distance and opening go straight
across gaps, as they weigh and decide no instant.

Not told apart: an object that was not recorded and is carried on before the hand rests. Cut such a
trial before that. */

#include <limits>
#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "human_study/events/filtered_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct HoldOptions {
  std::string rule = "multiplied";  ///< an id of HoldRuleList(), for what is not lifted
  double cutoff = 10.0;             ///< of the zero-phase filter on the tips [Hz]
  double speed_threshold = 0.05;    ///< [m/s]

  template <class V>
  void Visit(V&& v) {
    v("rule", rule, "how the hold is found of what is not lifted");
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the tips; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("speed_threshold_m_per_s", speed_threshold, {"tips that are faster do not hold", kAboveZero});
  }
};

/** A stretch of a trial in which the hand holds, and an instant of it. */
struct Hold {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]
  double begin = time;  ///< no visible tip is fast against the object from here .. [s]
  double end = time;    ///< .. to here
  std::string missing;  ///< why there is none; empty when there is one

  bool IsFound() const { return missing.empty() && time == time; }
};

/** The hold of an object lifted at that instant: from 0.1 s before to 0.5 s after. */
Hold MakeLiftedHold(double lift_off);

/** One number between 0 and 1 a sample each. */
struct HoldCriteria {
  std::vector<double> times;  ///< [s]
  Eigen::VectorXd slow, there, closed;
};

struct HoldRule {
  const char* id;
  const char* text;  ///< what it does and where it comes from, for methods sections
  /** A sample of the hold; -1 when there is none. */
  int (*find)(const HoldCriteria& criteria);
};

const std::vector<HoldRule>& HoldRuleList();
/** @throws Error(kNotFound) with a suggestion. */
const HoldRule& FindHoldRule(const std::string& id);

/** @param transport  path of the wrist in L, unfiltered.
@param opening  of the hand, filtered.
@param object_cutoff  of the object's pose [Hz].
@throws Error(kNotFound) for an unknown rule, Error(kRange) when a cut-off does not fit the rate. */
Hold FindHold(FilteredTrial& trial, const Trajectory& transport, const ScalarCurve& opening,
              const HoldOptions& options, double object_cutoff);

}  // namespace graspbench
