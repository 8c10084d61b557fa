#pragma once
/** @file
When an object left its support, from its unfiltered height, and how well that can be known.

A low-pass spreads the start of a lift: a threshold on the filtered speed comes early where the lift
starts at once, and late where it starts gently. With s the time since the lift-off t0, the height
is taken to be

    before   h = r + c (t - t0)
    after    h = r + c (t - t0) + v s + a s^2 / 2 + j s^3 / 6 + q s^4 / 24 + p s^5 / 120

r: place of rest; c: drift as the grip is built up. How a lift starts is not known beforehand: it
may break loose with a speed v, start with an acceleration a, a jerk j (a load force that grows
steadily over the object's weight, or a minimum-jerk path) or a snap q. Four models, one for each,
have the lower terms zero. They are weighed as the lift-offs are, by how well they explain the
samples (Bayes): t0 over a bracket of time, the rest integrated out, as it is linear with normal
priors.

An object that is gripped rocks by some 0.05 mm before it leaves, for 20 ms at a time; the weights of
the samples allow for it.

Known limits: without a shape, an object that tilts on its edge before it is free seems to leave as
its middle rises; with one, the height is that of its lowest point (ObjectTravel::lowest). */

#include <Eigen/Core>
#include <vector>

#include "human_study/events/scalar_curve.h"

namespace graspbench {

/** @param height  unfiltered, its noise the SD of a sample [m]. Filled samples take no part.
@param near  about when it leaves, by another rule [s].
@return missing when too few samples are measured about it. */
EventTime FitLiftOff(const ScalarCurve& height, double near);

}  // namespace graspbench
