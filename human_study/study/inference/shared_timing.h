#pragma once
/** @file
How much the touches of one trial's digits share beyond what the hand's transport explains, and
whether that is more than an error of the clock could be.

All touches of a trial are counted from one event of the hand, so an error of that event is shared
by all digits exactly as coordination is. Differences between digits are free of it, and of
coordination. So the error is made small and bounded:

    times     t_d - r, the touch of digit d less the instant r at which the wrist rose through 10 %
              of its peak speed
    adjusted  for how fast the wrist rose further (10 to 30 %, 30 to 60 %) and how far it went, by
              regression over all trials: what a profile or a distance does to r or to the touches
              is no coordination of the digits
    neighbours differences between successive trials of a person in a condition, less their mean,
              so that a steady drift of all digits is none either. Times that wander step by step
              (a random walk) leave half the squared step; but then the difference to the next trial
              does not take back the one before, as it does by half where trials share by
              themselves: from that product alone (`alternating_sd`) nothing is shared
    shared    variance of the digits' mean, less what digits on their own leave in it
    clock     the variance that r keeps: noise where it crosses, and half of what r varies about
              the start that the profile extrapolates to (Movement::start) within person and
              condition: the regression is trusted with half of it

Assumed: the profile's first part is a power of time; coordination does not follow the profile or
the distance (if it does it is not counted). */

#include <array>
#include <cmath>
#include <vector>

#include "core/statistics/jackknife.h"

namespace graspbench {

/** One trial as the hand and its digits tell it. */
struct SharedTimingTrial {
  std::vector<double> contacts;   ///< of each digit [s]
  double shared_variance = 0.0;   ///< of the errors that all contacts share [s^2]
  double clock = NAN;             ///< the wrist rose through 10 % of its peak speed [s]
  double clock_noise = 0.0;       ///< standard uncertainty of that by noise [s]
  double start = NAN;             ///< extrapolated [s]; NaN: not known
  std::vector<double> transport;  ///< rise times, distance; as many in every trial, may be none
};
/** Successive trials of one person in one condition. */
using SharedTimingRun = std::vector<SharedTimingTrial>;

struct SharedTiming {
  double shared_sd = NAN;      ///< of what the digits share; 0 when less than nothing [s]
  double shared_low_sd = NAN;  ///< at least this, with 95 % [s]
  double clock_sd = NAN;       ///< bound of the clock's error [s]
  /** The same spread from what one difference takes back of the one before; imprecise [s]. */
  double alternating_sd = NAN;
  double df = NAN;  ///< of the variance of the digits' mean

  /** More is shared than the clock's error can be, and it does not wander from trial to trial. */
  bool IsShown() const { return shared_low_sd > clock_sd && alternating_sd > clock_sd; }
};

/** @param runs  each of three trials or more. No answer with fewer than 5 degrees of freedom. */
Answer<SharedTiming> CalcSharedTiming(const std::vector<SharedTimingRun>& runs);

}  // namespace graspbench
