#pragma once
/** @file
The robustness basin of a grasp: the placement error that it tolerates, that of the object against
where the hand expects it.

Offsets are quasi-random points of the Halton sequence (bases 2, 3, 5; J. H. Halton, Numer. Math. 2,
1960) in the box +-10 mm in x and y, +-15 degrees in yaw, the same for every grasp; joints without
error. The distance of an offset is |(x / 10 mm, y / 10 mm, yaw / 15 deg)|. The basin's radius is
the distance of the nearest offset that fails, at most 1: in an ellipsoid of radius r, that is of
r * 10 mm and r * 15 degrees, all samples have succeeded. It is an upper bound that falls with the
number of samples. */

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

/** 0..1; 0 when the nominal pose itself fails. */
double CalcBasinRadius(const std::vector<BasinSample>& samples);

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
/** Its data dictionary. */
Json MakeBasinSchema();

}  // namespace graspbench
