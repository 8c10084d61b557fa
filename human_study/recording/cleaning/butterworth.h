#pragma once
/** @file
Zero-phase low-pass filtering: a second-order Butterworth run forwards and backwards.

Two passes lower the -3 dB point of the pair. For it to lie where it was asked for, each pass is
designed at the wanted frequency divided by (sqrt(2) - 1)^(1/4) = 0.8022, applied to the warped
analog frequency tan(pi f / f_s) (Robertson and Dowling 2003; Winter 2009, section 3.4.4.2).

The filter decides how sharp an event can be: its rise time from 10 to 90 % is 0.36 / cut-off, 36 ms
at 10 Hz. Cut-offs are in hertz, always. */

#include <Eigen/Core>
#include <vector>

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

/** The cut-off of a low-pass filter from the data (residual analysis; Winter, "Biomechanics and
Motor Control of Human Movement", 4th ed. 2009, section 3.4.4.3).

The residual R(f) is the root mean square of what a filter at f takes away. Where only noise is
taken away, R falls along a straight line; its value at 0 Hz estimates the noise. The cut-off is
where R equals that value: as much signal is lost there as noise is let through. */
struct ResidualAnalysis {
  std::vector<double> cutoffs;    ///< [Hz]
  std::vector<double> residuals;  ///< R [m], over the three axes
  double noise = 0.0;   ///< value of the line at 0 Hz [m]: noise of the three axes together
  double cutoff = 0.0;  ///< [Hz]; NaN when the curve never meets the noise
};

/** Tries cut-offs from 1 Hz to a quarter of the sampling rate in steps of 0.5 Hz and fits the line
to the upper half of them, on the longest run of valid samples.
@throws Error(kRange) when that run is shorter than one second, the sampling is not even or the rate
is below 20 Hz. */
ResidualAnalysis FindCutoff(const Trajectory& trajectory);

/* Was a recording low-passed before it was exported?

A camera's noise is white: as much of it per hertz at 20 Hz as just below half the rate. A filter
takes it away above its cut-off and nothing puts it back. In stretches of half a second in which a
marker hardly moves, recordings as they were taken have about as much power between 15 and 25 Hz as
near half their rate; filtered ones have hundreds of times more.

A filter that runs with the recording (causal) makes every instant later, a Butterworth of second
order by 0.225 / cut-off; one that runs forwards and backwards makes none later but blurs contacts,
and the spectrum does not tell which. Both take away the noise from which uncertainties are taken.

Known limits: seen below about a sixth of the rate only. Noise of less than 2 um tells nothing, as
of synthetic recordings. Coordinates rounded coarser than the noise that is left hide the filter. */

/** Cut-off (-3 dB) of the low-pass that explains the spectrum best, to about a third [Hz]; NaN when
nothing was filtered or it cannot be told.
@param tracks  of one recording with one clock, unfiltered as far as is known, not filled. */
double FindLowPassTrace(const std::vector<const Trajectory*>& tracks);

}  // namespace graspbench
