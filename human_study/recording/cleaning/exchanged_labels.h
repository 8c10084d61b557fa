#pragma once
/** @file
Markers that carry each other's label from one frame on, for one frame or for the rest.

From frame i to frame j a marker goes on as it moved: by v_i (t_j - t_i), by v_j (t_j - t_i) or by
their mean, with v_i its mean velocity over three frames up to i and v_j that over three from j on.
What it misses of the nearest is its own step's miss; under another's label it misses

    |p_y(j) - p_x(i) - v (t_j - t_i)|.

Where two markers exchange their labels each misses its own course by as much as they are apart, and
the other's by noise. Nothing that a hand does looks like this, at any rate: digits that cross keep
their courses, a spike or a lost frame is not on the other's. */

#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

struct LabelExchange {
  size_t sample = 0;      ///< the first one after it
  size_t label = 0;       ///< index of the track that goes on where another was ..
  size_t other = 0;       ///< .. index of that one
  double distance = 0.0;  ///< by which `label` misses its own course [m]
};

/** A label misses its own course by 5 mm and four times its usual miss (median), and another's by
less than 0.35 of that. The other is hidden, or misses its own by half as much or more and not the
same way, as it does where frames are lost. Gaps of at most 0.12 s count. Markers nearer to each
other than that are not told apart.
@param tracks  of one clock, before single samples are taken out.
@returns in the order of time. */
std::vector<LabelExchange> FindLabelExchanges(const std::vector<Trajectory>& tracks);

}  // namespace graspbench
