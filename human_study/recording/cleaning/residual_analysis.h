#pragma once
/** @file
The cut-off of a low-pass filter from the data (residual analysis; Winter, "Biomechanics and Motor
Control of Human Movement", 4th ed. 2009, section 3.4.4.3).

The residual R(f) is the root mean square of what a filter at f takes away. Where only noise is
taken away, R falls along a straight line; its value at 0 Hz estimates the noise. The cut-off is
where R equals that value: as much signal is lost there as noise is let through. */

#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

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

}  // namespace graspbench
