#pragma once
/** @file
Prediction of a standard grasp of this hand on this mesh by geometry alone, before any trial. It
tells whether the placement reaches the object, whether the open hand arrives without touching it,
and how the closing digits meet it.

The object may deviate from its nominal pose by kPlacementOffset in x and y and by kPlacementYaw
(method: the variation between trials). Joints err by the hand's accuracy, which moves a fingertip
by at most accuracy times finger length. The approach is clear when every digit keeps more than this
distance on the straight path, for the nominal pose and every corner of the range of poses.

Closing is computed kinematically: each digit closes until one of its links meets the object at its
nominal pose. Pushed objects and compliant digits are not modelled. Two conditions that are
necessary for a grasp with friction mu are then tested. The forces along the surface normals, thumb
against the mean of the others, must oppose each other within twice atan(mu). The mean surface
normal must not point up by more than atan(mu), since squeezing would then push the object out of
the hand.

All of this is proposed by graspbench. */

#include <tuple>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kPlacementOffset = 0.005;  ///< variation in x and y [m]
inline constexpr double kPlacementYaw = 5.0 * kPi / 180.0;

struct GraspPrediction {
  double reach_miss = 0.0;     ///< distance by which the pads miss the object [m]; 0: they reach it
  double room = 0.0;           ///< smallest gap between open digits and object; negative where a
                               ///< digit would be inside it [m]
  double needed_room = 0.0;    ///< required gap: joint accuracy times finger length [m]
  int num_digits = 0;          ///< grasping digits
  int num_touching = 0;        ///< grasping digits that touch when the hand has closed
  bool thumb_touches = false;  ///< the opposing digit is one of them
  bool opposes = false;        ///< normals of the thumb and the others oppose each other
  bool lifts = false;          ///< normals do not point up
  /** Height above the centre of mass of the contacts, thumb averaged with the mean of the others
  [m]; an object that is pushed above it tips. */
  double contact_height = 0.0;
  bool palm_is_near = false;  ///< the palm may touch, and stops within 3.5 mm of the near face

  bool reaches() const { return reach_miss <= 0.0; }
  /** Whether the opposing digit and another one meet the object as the hand closes. */
  bool meets() const { return thumb_touches && num_touching >= 2; }
  bool is_clear() const { return room >= needed_room; }
  bool holds() const { return opposes && lifts && num_touching == num_digits; }
};

/** How promising a grasp is by geometry; larger is better. Its members are criteria in order of
priority. An object that is pushed above its centre of mass tips, so low contacts are preferred. */
struct GraspRank {
  int meets = -1;         ///< 0: misses the object, 1: reaches it, 2: also meets it when closing
  bool has_held = false;  ///< held at least half of the shapes held out in development, or unknown
  int num_kept = 0;       ///< of: clear approach, opposed forces, all digits touch, palm near
  double depth = 0.0;     ///< of the contacts below the object's centre of mass [m]

  bool operator>(const GraspRank& other) const {
    return std::tie(meets, has_held, num_kept, depth) >
           std::tie(other.meets, other.has_held, other.num_kept, other.depth);
  }
};
GraspRank RankGrasp(const Grasp& grasp, const GraspPrediction& prediction);

/** @pre the object has its distance field. */
GraspPrediction PredictGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** Whether the grasp reaches the object and would be clear of it even if it filled its bounding
box; needs no distance field. Such a grasp need not be fitted. */
bool ClearsBoundingBox(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** Fits the grasp to this object: opens its pre-grasp along the line from target to pre-grasp,
within the joint limits, until the approach is clear. If neither grasp nor object chooses an
approach, the rule's (placement.h) is used by default. The other is used if only it is clear and
meets the object, or if a palm that may touch supports the grip only there. If neither is clear, the
one that brings the palm near is used. Returns the grasp unchanged if it is clear, was made for one
object, or cannot be improved. @pre as PredictGrasp. */
Grasp FitGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** Fits the grasp to a placement that deviates from the rule's by `change`; the result has this
placement. The pre-grasp is opened by the share `opening` of the path from target to pre-grasp, and
further until the approach is clear. If nothing helps, it has exactly that opening.
@pre as PredictGrasp. */
Grasp FitGraspAt(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                 const PlaceChange& change, double opening);

}  // namespace graspbench
