#pragma once
/** @file
The design of `graspbench map simultaneity`: sessions whose conditions are regions of grip and
object properties, each without delay and with the last or first digit delayed.

The regions are a regular fractional factorial of two-level factors (G. E. P. Box and J. S. Hunter,
Technometrics 3 (1961)); a factor with four levels takes two columns. With the grip there are seven
columns and 32 runs of resolution IV, with the generators offset = law x speed x grip1 x grip2 and
mass = law x speed x grip2 x friction. Without the grip there are five columns and 16 runs of
resolution V, with mass = law x speed x friction x offset. So every two levels of two factors occur
together equally often. A firm grip closes to its posture and has no drive law: its four regions
with the law "saturating" are left out. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

struct MapLevelRow {
  std::string name;     ///< for display: "margin 1.5"
  std::string setting;  ///< of a condition (conditions.h)
};
struct MapFactorRow {
  std::string name;
  std::vector<MapLevelRow> levels;  ///< two or four, the base's first
  bool scales_draws = false;        ///< the levels scale the object's offset
};
/** Drive law, speed after touch, grip, friction, offset, mass. */
const std::vector<MapFactorRow>& ListMapFactors();

/** One session of a map. */
struct MapPart {
  const char* id;  ///< name of its folder
  const char* title;
  bool varies_grip;
  std::vector<double> delays;  ///< of the last and of the first digit [s]
  int most_trials;             ///< of each hand, object and region
  int most_objects;            ///< chosen by the seed; 0: all
  bool with_thresholds, with_judge;
};
/** The sessions of a map. @param is_quick  success only, with one delay and one draw. */
std::vector<MapPart> ListMapParts(bool is_quick);

/** Makes the session of one part. The draws of each object are chosen to give some sixty trials per
hand and region: more objects get fewer draws, because objects are more informative than draws.
@param base  gives hands, objects and seed; the keys of the factors are set to their base level.
@throws as ApplyCondition. */
SessionConfig MakeMapSession(const MapPart& part, SessionConfig base);

/** Whether a session is the first part of a map, of either size. */
bool IsMap(const SessionConfig& config);

/** Index of each factor's level under each condition; the grip has its base level where it is not
varied. */
std::vector<std::vector<size_t>> ListMapLevels(const std::vector<Condition>& conditions,
                                               const SessionConfig& config);

}  // namespace graspbench
