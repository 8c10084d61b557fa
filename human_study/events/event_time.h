#pragma once
/** @file
An instant found in recorded data, with what it rests on.

The uncertainty is a standard uncertainty (one standard deviation) [s], the root of the sum of
squares of

    sampling   T / sqrt(12): the frame of length T in which it lies
    noise      s / |slope|: noise of the signal over its slope where it decides
    rule       spread of the instants for half and one and a half times the threshold, / sqrt(12)
    gap        length of the gap it falls into, / sqrt(12)

as far as they apply. "Rule" covers the smoothing, too: a filter that smears a step moves those
instants apart. What is not covered: an error common to all trials, such as a wrong shape. */

#include <limits>
#include <string>

#include "core/statistics/distributions.h"

namespace graspbench {

struct EventTime {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< on the trial's clock [s]; NaN: none
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< standard [s]
  bool is_filled = false;  ///< a filled sample lies where the event was decided
  bool is_in_gap = false;  ///< fell into a gap (`time` is its middle); a maximum: beside one
  std::string missing;     ///< why there is none; empty when there is one

  bool IsFound() const { return missing.empty() && time == time; }
  double CalcHalfWidth() const { return kNormal95 * uncertainty; }  ///< of the 95 % interval [s]
};

/** An event that was not found, and why. */
inline EventTime MissingEvent(std::string why) {
  EventTime event;
  event.missing = std::move(why);
  return event;
}

}  // namespace graspbench
