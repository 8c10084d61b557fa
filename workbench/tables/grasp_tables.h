#pragma once
/** @file
Standard grasps of a hand as numbers, and what their types are called elsewhere: for a person, for a
spreadsheet, for a program. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Side of the block before which the placements stand [m]: a placement depends on the object. */
inline constexpr double kReferenceBlock = 0.05;

/** One number of a grasp. */
struct GraspNumber {
  std::string grasp;  ///< "g1"
  std::string part;   ///< "placement", "pre-grasp", "target"
  std::string name;   ///< "x", "roll", "distance", a joint's
  std::string unit;   ///< "mm", "deg"
  double value = 0.0;
};

/** Grasp by grasp: where the palm's frame H stands to the middle of a block of 50 mm on the table
(position; roll, pitch, yaw as in URDF), the direction of the approach, its distance, the yaw alpha
between object and opposition axis and the tilt; then every joint, coupled ones too, of the
pre-grasp and of the target. */
std::vector<GraspNumber> ListGraspNumbers(const Hand& hand, const std::vector<Grasp>& grasps);

/** A column a grasp, and of joints two: pre-grasp and target. */
std::string FormatGraspNumbers(const std::vector<Grasp>& grasps,
                               const std::vector<GraspNumber>& numbers);
/** A line a number. */
std::string FormatGraspCsv(const std::vector<GraspNumber>& numbers);
/** Its data dictionary. */
Json MakeGraspNumberSchema();

/** The types t1 to t4 in seven taxonomies (core/grasp/standard_grasp.h). */
std::string FormatGraspTypes();
Json MakeGraspTypesJson();

}  // namespace graspbench
