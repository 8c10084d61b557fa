#pragma once
/** @file
Was a recording low-passed before it was exported?

A camera's noise is white: as much of it per hertz at 20 Hz as just below half the rate. A filter
takes it away above its cut-off and nothing puts it back. In stretches of half a second in which a
marker hardly moves, recordings as they were taken have about as much power between 15 and 25 Hz as
near half their rate; filtered ones have hundreds of times more.

A filter that runs with the recording (causal) makes every instant later, a Butterworth of second
order by 0.225 / cut-off; one that runs forwards and backwards makes none later but blurs contacts,
and the spectrum does not tell which. Both take away the noise from which uncertainties are taken.

Known limits: seen below about a sixth of the rate only. Noise of less than 2 um tells nothing, as
of made-up recordings. Coordinates rounded coarser than the noise that is left hide the filter. */

#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** Cut-off (-3 dB) of the low-pass that explains the spectrum best, to about a third [Hz]; NaN when
nothing was filtered or it cannot be told.
@param tracks  of one recording with one clock, unfiltered as far as is known, not filled. */
double FindLowPassTrace(const std::vector<const Trajectory*>& tracks);

}  // namespace graspbench
