#pragma once
/** @file
The design of graspbench map simultaneity: sessions whose conditions are regions of how a hand grips
and of what it grips, each without delay and with the last or first digit late.

Regions are a regular fraction of two-level factors, a factor of four levels taking two columns
(G. E. P. Box and J. S. Hunter, Technometrics 3 (1961)): of seven columns 32 runs of resolution IV,
offset = law x speed x grip1 x grip2 and mass = law x speed x grip2 x friction; without the grip,
five columns, 16 runs of resolution V, mass = law x speed x friction x offset. So every two levels
of two factors meet equally often. A firm grip closes to its posture and has no drive law: its four
regions with the law "saturating" are left out. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

struct MapLevelRow {
  std::string name;     ///< for people: "margin 1.5"
  std::string setting;  ///< of a condition (conditions.h)
};
struct MapFactorRow {
  std::string name;
  std::vector<MapLevelRow> levels;  ///< that of the base first; two or four
  bool scales_draws = false;        ///< how far they put the object off
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
  int most_objects;            ///< dealt by the seed; 0: all
  bool with_thresholds, with_judge;
};
/** @param is_quick  success alone, with one delay and one draw. */
std::vector<MapPart> ListMapParts(bool is_quick);

/** So many draws of each object as make some sixty trials of a hand in a region: of more objects
fewer, because more objects tell more than more draws.
@param base  hands, objects and seed are kept; what the factors vary is set.
@throws as ApplyCondition. */
SessionConfig MakeMapSession(const MapPart& part, SessionConfig base);

/** Whether a session is the first part of a map, of either size. */
bool IsMap(const SessionConfig& config);

/** The level of each factor under each condition; the grip's is the base's where it is not varied.
*/
std::vector<std::vector<size_t>> ListMapLevels(const std::vector<Condition>& conditions,
                                               const SessionConfig& config);

}  // namespace graspbench
