#pragma once
/** @file
What the samples of one grasp's robustness basin say; see core/trial/basin.h for what is tried. */

#include <string>
#include <vector>

#include "core/trial/basin.h"
#include "datasets/session/session.h"

namespace graspbench {

struct BasinSummary {
  int num_samples = 0;
  int num_successes = 0;
  double radius = 0.0;         ///< 0..1, of the ellipsoid in which every sample succeeded
  double radius_offset = 0.0;  ///< its half-axes [m]
  double radius_yaw = 0.0;     ///< [rad]
  double most_sigma = 0.0;     ///< largest of all samples [N]
  std::string rate;            ///< of success in the whole box, with its interval
};
BasinSummary SummariseBasin(const std::vector<BasinSample>& samples);

/** Whether a session's draws are those of a basin. */
bool IsBasin(const Session& session);
/** Its finished trials. @pre IsBasin(session). */
std::vector<BasinSample> ListBasinSamples(const Session& session);
/** "TUM Hand, tennis ball, g3". */
std::string NameBasin(const SessionInputs& inputs, const PlannedTrial& planned);

/** One row per sample: offset_x_m, offset_y_m, yaw_rad, distance, outcome, sigma. */
std::string FormatBasinCsv(const std::vector<BasinSample>& samples);

}  // namespace graspbench
