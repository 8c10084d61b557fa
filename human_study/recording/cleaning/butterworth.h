#pragma once
/** @file
Zero-phase low-pass filtering: a second-order Butterworth filter, applied forwards and backwards.

Two passes lower the -3 dB point of the pair. To place it at the wanted cut-off, each pass is
designed for this frequency divided by (sqrt(2) - 1)^(1/4) = 0.8022, applied to the warped analog
frequency tan(pi f / f_s) (Robertson and Dowling 2003; Winter 2009, section 3.4.4.2).

The filter limits the sharpness of events: its rise time from 10 to 90 % is 0.36 / cut-off, 36 ms at
10 Hz. All cut-offs are in hertz. */

#include <Eigen/Core>
#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** y[n] = b0 x[n] + b1 x[n-1] + b2 x[n-2] - a1 y[n-1] - a2 y[n-2]. */
struct Biquad {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/** Designs one pass of the pair. @throws Error(kRange) unless 0 < cutoff < 0.8 * rate / 2 [Hz]. */
Biquad MakeLowPass(double cutoff, double rate);

/** Applies both passes to one signal. The ends are extended by point reflection, and the filter
starts in steady state at the first value, so a constant or a ramp passes unchanged. */
Eigen::VectorXd FilterZeroPhase(const Biquad& pass, const Eigen::VectorXd& signal);
/** Filters each row. */
Eigen::Matrix3Xd FilterZeroPhase(const Biquad& pass, const Eigen::Matrix3Xd& signals);

/** Filters each run of valid samples separately; states are unchanged. Samples must be evenly
spaced.
@throws Error(kRange) as MakeLowPass, or when the sampling is not even (resample first). */
void FilterLowPass(Trajectory& trajectory, double cutoff);

/** Finds the cut-off of a low-pass filter from the data (residual analysis; Winter, "Biomechanics
and Motor Control of Human Movement", 4th ed. 2009, section 3.4.4.3).

The residual R(f) is the root mean square of the part removed by a filter at f. Where only noise is
removed, R falls along a straight line, whose value at 0 Hz estimates the noise. The cut-off is
where R equals this value: there, the signal removed equals the noise passed. */
struct ResidualAnalysis {
  std::vector<double> cutoffs;    ///< [Hz]
  std::vector<double> residuals;  ///< R [m], over the three axes
  double noise = 0.0;             ///< value of the line at 0 Hz [m]: noise of all three axes
  double cutoff = 0.0;            ///< [Hz]; NaN when the curve never reaches the noise
};

/** Evaluates cut-offs from 1 Hz to a quarter of the sampling rate in steps of 0.5 Hz on the longest
run of valid samples, and fits the line to their upper half.
@throws Error(kRange) when this run is shorter than 1 s, the sampling is uneven or the rate is below
20 Hz. */
ResidualAnalysis FindCutoff(const Trajectory& trajectory);

/* Detects whether a recording was low-pass filtered before export.

Camera noise is white: its density at 20 Hz equals that just below half the rate. A filter removes
it above the cut-off. In stretches of 0.5 s in which a marker hardly moves, unfiltered recordings
have about equal power density between 15 and 25 Hz and near half their rate; in filtered ones the
former is hundreds of times larger.

A causal filter delays every event, a second-order Butterworth filter by 0.225 / cut-off. A
zero-phase filter delays none but blurs contacts. The spectrum does not distinguish them. Both
remove the noise from which uncertainties are estimated.

Known limits: a cut-off is only detected below about a sixth of the rate. Noise below 2 um, as in
synthetic recordings, is inconclusive. Coordinates rounded more coarsely than the remaining noise
hide the filter. */

/** Estimates the cut-off (-3 dB) of the low-pass filter that best explains the spectrum, to about a
third [Hz]. NaN when the recording is unfiltered or the result is inconclusive.
@param tracks  of one recording with one clock, not filtered here and not filled. */
double FindLowPassTrace(const std::vector<const Trajectory*>& tracks);

}  // namespace graspbench
