#pragma once
/** @file
The taxonomy: four grasp types t1..t4 and the standard grasps that realise them. These are g1..g5
(Roethling 2007, chapter 3) and g6, which encloses an object without the palm (proposed). A grasp
consists of a pre-grasp posture, a target posture (reached with nothing between the fingers), the
pose of the hand relative to the object, and an approach distance d. Both d and alpha belong to the
grasp and are the same for every hand; the rest belongs to the hand and is read from hand.yaml. */

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/grasp/closing_law.h"
#include "core/grasp/grasp_course.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

enum class GraspType { kAllFingerPrecision, kTwoFingerPrecision, kPower, kTwoFingerPinch };

/** Least distance between palm and object, and the default distance of power grasps [m]. */
inline constexpr double kPalmGap = 0.003;

struct GraspTaxon {
  std::string id;            ///< "g1".."g6"
  std::string name;          ///< "all finger precision", ..., "three finger special"
  GraspType type;            ///< g5 (three fingers) and g6 (encompassing) are of type t1
  double approach_distance;  ///< d [m], hand-independent
  double alpha;              ///< yaw between the object's long axis and the opposition axis [rad]
};
/** g1..g6 in order. */
const std::vector<GraspTaxon>& ListGraspTaxa();
/** @throws Error(kNotFound) with suggestions. */
const GraspTaxon& FindGraspTaxon(const std::string& id);

/** Pose of the hand relative to the object, and the direction from which it comes. */
struct Placement {
  Pose X_WH =
      Pose::Identity();  ///< at the grasp position, for an object with p_WO = (0, 0, height/2)
  Eigen::Vector3d approach_W = -Eigen::Vector3d::UnitZ();  ///< unit; the hand moves along it by d
  double closing_at_contact = 1.0;                         ///< s*, in [0, 1]
  bool reaches_object = true;  ///< false: links would meet the object before the pads hold it
};

/** One grasp of one hand. The pose of the hand follows from the postures (placement.h), unless the
grasp was made for one object and has its own placement. */
struct Grasp {
  std::string id;  ///< "g1".."g6", or the name of an optimised grasp
  GraspType type = GraspType::kAllFingerPrecision;
  double approach_distance = 0.1;  ///< d [m]
  double alpha = 0.0;              ///< [rad]
  double tilt = 0.0;  ///< angle by which a hand from above is turned from the palm's normal towards
                      ///< the fingertips, so that curled fingers stay above the pinch point [rad]
  Eigen::VectorXd q_pre;            ///< (num_joints) [rad], coupled joints filled in
  Eigen::VectorXd q_target;         ///< (num_joints) [rad]
  std::vector<std::string> digits;  ///< ids of the grasping digits; closure ends when all touch
  std::map<std::string, ClosingSchedule> closing;  ///< by digit; others have the default
  bool palm_may_touch = false;                     ///< in power and encompassing grasps
  double palm_gap = kPalmGap;  ///< if the palm may touch: palm to object as closing begins [m]
  /** The hand advances until its palm touches (core/trial/protocols/palm_approach.h). */
  bool seeks_palm = false;
  /** Share of the shapes held out in development that it held (core/develop); NaN: unknown. */
  double held_share = kUnset;
  /** Share of the held shapes that were held with the opposition of its type; NaN: unknown. */
  double as_called_share = kUnset;
  Approach approach = Approach::kAutomatic;
  std::string object;                  ///< id of the object it was made for; empty: any
  std::optional<Placement> placement;  ///< absent: computed from postures and sizes
  GraspCourse course;                  ///< recorded reach that placing and closing follow, if set
};

/** Index into hand.digits of the digit that opposes the others: the thumb, or the first grasping
digit if the thumb does not take part. @pre the grasp has digits of this hand. */
int FindOpposingDigit(const Hand& hand, const Grasp& grasp);

/** Reads all standard grasps that the hand can perform from its hand.yaml.
@throws Error(kFormat) listing every problem with file and line. */
std::vector<Grasp> LoadStandardGrasps(const Hand& hand);

/** Names of the four grasp types in an earlier taxonomy (Roethling 2007, chapter 2). They name
postures of human hands, so they correspond only approximately. */
struct GraspTaxonomy {
  const char* author;
  int year;
  /** By GraspType: all finger precision, two finger precision, power, two finger pinch; "-": no
  such grasp. */
  std::array<const char*, 4> names;
};

inline constexpr GraspType kGraspTypes[] = {GraspType::kAllFingerPrecision,
                                            GraspType::kTwoFingerPrecision, GraspType::kPower,
                                            GraspType::kTwoFingerPinch};

/** Seven taxonomies, by year. */
const std::vector<GraspTaxonomy>& ListGraspTaxonomies();

/** "t1" to "t4". */
const char* CodeOf(GraspType type);
const char* NameOf(GraspType type);  ///< "all finger precision"

}  // namespace graspbench
