#pragma once
/** @file
Zero-phase low-pass filtering: a second-order Butterworth run forwards and backwards.

Two passes lower the -3 dB point of the pair. For it to lie where it was asked for, each pass is
designed at the wanted frequency divided by (sqrt(2) - 1)^(1/4) = 0.8022, applied to the warped
analog frequency tan(pi f / f_s) (Robertson and Dowling 2003; Winter 2009, section 3.4.4.2).

The filter decides how sharp an event can be: its rise time from 10 to 90 % is 0.36 / cut-off, 36 ms
at 10 Hz. Cut-offs are in hertz, always. */

#include <Eigen/Core>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** y[n] = b0 x[n] + b1 x[n-1] + b2 x[n-2] - a1 y[n-1] - a2 y[n-2]. */
struct Biquad {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/** One pass of the pair. @throws Error(kRange) unless 0 < cutoff < 0.8 * rate / 2 [Hz]. */
Biquad MakeLowPass(double cutoff, double rate);

/** Both passes over one signal. The ends are continued by point reflection and the filter starts at
rest on the first value, so a constant or a ramp passes unchanged. */
Eigen::VectorXd FilterZeroPhase(const Biquad& pass, const Eigen::VectorXd& signal);
/** The same of each row. */
Eigen::Matrix3Xd FilterZeroPhase(const Biquad& pass, const Eigen::Matrix3Xd& signals);

/** Filters each run of valid samples on its own; states stay. Samples must be evenly spaced.
@throws Error(kRange) as MakeLowPass, or when the sampling is not even (resample first). */
void FilterLowPass(Trajectory& trajectory, double cutoff);

}  // namespace graspbench
