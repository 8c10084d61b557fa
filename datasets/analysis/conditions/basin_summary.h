#pragma once
/** @file
The robustness basin of a grasp: the object placement errors, relative to the pose expected by the
hand, that it tolerates.

Offsets are quasi-random points of the Halton sequence (bases 2, 3, 5; J. H. Halton, Numer. Math. 2,
1960) in the box +-10 mm in x and y and +-15 degrees in yaw, the same for every grasp; joints have
no error. The distance of an offset is |(x / 10 mm, y / 10 mm, yaw / 15 deg)|. The basin's radius r
is the distance of the nearest failed offset, at most 1: all samples succeeded in the ellipsoid with
the half-axes r * 10 mm and r * 15 degrees. It is an upper bound that decreases with the number of
samples. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/trial/outcome.h"
#include "datasets/session/session_store.h"

namespace graspbench {

inline constexpr double kBasinOffset = 0.01;           ///< [m]
inline constexpr double kBasinYaw = RadFromDeg(15.0);  ///< [rad]

struct BasinSample {
  double offset_x = 0.0;  ///< [m]
  double offset_y = 0.0;  ///< [m]
  double yaw = 0.0;       ///< [rad]
  Outcome outcome = Outcome::kNotRun;
  double sigma = kUnset;  ///< [N]
};

double CalcBasinDistance(const BasinSample& sample);

/** Returns the radius, 0..1; 0 if the nominal pose fails. */
double CalcBasinRadius(const std::vector<BasinSample>& samples);

struct BasinSummary {
  int num_samples = 0;
  int num_successes = 0;
  double radius = 0.0;         ///< 0..1, of the ellipsoid in which all samples succeeded
  double radius_offset = 0.0;  ///< its half-axes [m]
  double radius_yaw = 0.0;     ///< [rad]
  double most_sigma = 0.0;     ///< largest sigma of all samples [N]
  std::string rate;            ///< success rate in the whole box, with interval
};
BasinSummary SummariseBasin(const std::vector<BasinSample>& samples);

/** Whether a session's draws are those of a basin. */
bool IsBasin(const Session& session);
/** Lists the finished trials of a basin. @pre IsBasin(session). */
std::vector<BasinSample> ListBasinSamples(const Session& session);
/** Returns "TUM Hand, tennis ball, g3". */
std::string NameBasin(const SessionInputs& inputs, const PlannedTrial& planned);

/** Writes one row per sample: offset_x_m, offset_y_m, yaw_rad, distance, outcome, sigma. */
std::string FormatBasinCsv(const std::vector<BasinSample>& samples);
/** Returns the data dictionary of basin.csv. */
Json MakeBasinSchema();

}  // namespace graspbench
