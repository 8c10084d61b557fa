#pragma once
/** @file
A digit that touches, leaves again and returns before the object is held.

A contact (DigitContactEvents::contact) is that of the final hold: what detectors look back from. A
digit that was at the place where it holds before, left it by more than 4 mm (six standard deviations
of the noise) and came back has touched earlier, too; GFT and the other measures are those of the
final hold, and the trial carries a flag.

    first_touch  the departure from the place in the hold first fell below 2 mm (three standard
                 deviations), late by some 10 ms with soft arrivals
    release      it last rose through that before it was farthest */

#include "human_study/events/event_time.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct Regrasp {
  EventTime first_touch, release;
  double left_by = 0.0;  ///< largest departure between release and the final contact [m]

  bool IsFound() const { return first_touch.IsFound(); }
};

/** @param departure  of the tip from its place in the hold, in the object's frame, filtered [m].
@param begin,contact  the search goes from one to the other [s]. */
Regrasp FindRegrasp(const ScalarCurve& departure, double begin, double contact);

}  // namespace graspbench
