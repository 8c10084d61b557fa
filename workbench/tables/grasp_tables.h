#pragma once
/** @file
Standard grasps of a hand as numbers, and the names of their types in other taxonomies: as text, CSV
and JSON. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Side of the cube for which placements are computed [m], since a placement depends on the
object. */
inline constexpr double kReferenceBlock = 0.05;

/** One number of a grasp. */
struct GraspNumber {
  std::string grasp;  ///< "g1"
  std::string part;   ///< "placement", "pre-grasp", "target"
  std::string name;   ///< "x", "roll", "distance", a joint's
  std::string unit;   ///< "mm", "deg"
  double value = 0.0;
};

/** Lists for each grasp the pose of the palm's frame H relative to the centre of a 50 mm block on
the table (position; roll, pitch, yaw as in URDF), the approach direction and distance, the yaw
alpha between object and opposition axis, and the tilt. Then lists every joint, coupled ones
included, of the pre-grasp and of the target. */
std::vector<GraspNumber> ListGraspNumbers(const Hand& hand, const std::vector<Grasp>& grasps);

/** One column per grasp; for joints two columns: pre-grasp and target. */
std::string FormatGraspNumbers(const std::vector<Grasp>& grasps,
                               const std::vector<GraspNumber>& numbers);
/** One row per number. */
std::string FormatGraspCsv(const std::vector<GraspNumber>& numbers);
/** Data dictionary of this CSV. */
Json MakeGraspNumberSchema();

/** Names of the types t1 to t4 in seven taxonomies (core/grasp/standard_grasp.h). */
std::string FormatGraspTypes();
Json MakeGraspTypesJson();

}  // namespace graspbench
