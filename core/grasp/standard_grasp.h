#pragma once
/** @file
The taxonomy: four grasp types t1..t4 and the standard grasps that realise them: g1..g5 (Roethling
2007, chapter 3), and g6, which encloses an object without the palm (proposed). A grasp is a pre-
grasp posture, a target posture (reached with nothing between the fingers), where the hand stands to
the object, and an approach distance d. d and alpha belong to the grasp and are the same for every
hand; the rest belongs to the hand and is read from its hand.yaml. */

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/grasp/closing_law.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

enum class GraspType { kAllFingerPrecision, kTwoFingerPrecision, kPower, kTwoFingerPinch };

/** Palm to object, at least; of a power grasp that says nothing else exactly [m]. */
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

/** Where the hand stands to the object, and from where it comes. */
struct Placement {
  Pose X_WH =
      Pose::Identity();  ///< at the grasp position, for an object with p_WO = (0, 0, height/2)
  Eigen::Vector3d approach_W = -Eigen::Vector3d::UnitZ();  ///< unit; the hand moves along it by d
  double closing_at_contact = 1.0;                         ///< s*, in [0, 1]
  bool reaches_object = true;  ///< false: links would meet the object before the pads hold it
};

/** One grasp of one hand. Where the hand stands follows from the postures (placement.h), unless
the grasp was made for one object and brings its placement. */
struct Grasp {
  std::string id;  ///< "g1".."g6", or the name of an optimised grasp
  GraspType type = GraspType::kAllFingerPrecision;
  double approach_distance = 0.1;  ///< d [m]
  double alpha = 0.0;              ///< [rad]
  double tilt = 0.0;  ///< from above, the hand is turned by this from the palm's normal towards the
                      ///< fingertips, so that curled fingers stay above the pinch point [rad]
  Eigen::VectorXd q_pre;            ///< (num_joints) [rad], coupled joints filled in
  Eigen::VectorXd q_target;         ///< (num_joints) [rad]
  std::vector<std::string> digits;  ///< ids of the grasping digits; contact of all ends the closure
  std::map<std::string, ClosingSchedule> closing;  ///< by digit; those left out close as all do
  bool palm_may_touch = false;                     ///< power, encompassing precision
  double palm_gap = kPalmGap;  ///< where the palm may touch: palm to object as closing begins [m]
  /** The hand comes on until its palm touches (core/trial/protocols/palm_approach.h). */
  bool seeks_palm = false;
  /** Of shapes not met in development, the share that it held (core/develop); NaN: not known. */
  double held_share = kUnset;
  /** Of those that it held, the share with the opposition of its name; NaN: not known. */
  double as_called_share = kUnset;
  Approach approach = Approach::kAutomatic;
  std::string object;                  ///< id of the object it was made for; empty: any
  std::optional<Placement> placement;  ///< absent: computed from postures and sizes
};

/** The digit that opposes the others: the thumb, or the first grasping digit of a grasp without it.
Index into hand.digits. @pre the grasp has digits of this hand. */
int FindOpposingDigit(const Hand& hand, const Grasp& grasp);

/** All standard grasps the hand can do, from its hand.yaml.
@throws Error(kFormat) listing every problem with file and line. */
std::vector<Grasp> LoadStandardGrasps(const Hand& hand);

/** What the four grasp types are called in an earlier taxonomy (Roethling 2007, chapter 2): names
of hand postures of people, so a relation, no equality. */
struct GraspTaxonomy {
  const char* author;
  int year;
  /** By GraspType: all finger precision, two finger precision, power, two finger pinch; "-": it has
  no such grasp. */
  std::array<const char*, 4> names;
};

inline constexpr GraspType kGraspTypes[] = {GraspType::kAllFingerPrecision,
                                            GraspType::kTwoFingerPrecision, GraspType::kPower,
                                            GraspType::kTwoFingerPinch};

/** Seven of them, by year. */
const std::vector<GraspTaxonomy>& ListGraspTaxonomies();

/** "t1" to "t4". */
const char* CodeOf(GraspType type);
const char* NameOf(GraspType type);  ///< "all finger precision"

}  // namespace graspbench
