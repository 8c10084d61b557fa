#pragma once
/** @file
What geometry says of a standard grasp of this hand on this mesh, before any trial: whether the
placement reaches it, whether the open hand comes there without touching it, and how its digits will
meet it when they close.

The object may stand off its nominal place by kPlacementOffset in x and y and kPlacementYaw (method:
the variation between trials), and joints err by the hand's accuracy, which moves a fingertip by
accuracy times a finger's length. The way is clear when, for the object at its nominal place and in
every corner of that box, no digit comes nearer to it on the straight approach than that.

Closing is followed kinematically, each digit until one of its links meets the object where it
nominally stands: objects that are pushed and digits that yield are not foreseen. The fit is then
judged by two conditions that are necessary for a grasp by friction mu alone: the forces along the
surface normals, thumb against the mean of the others, oppose each other within twice atan(mu), and
the mean surface normal does not point up by more than atan(mu), or squeezing would push the object
out of the hand.

All of this is proposed by graspbench. */

#include <tuple>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kPlacementOffset = 0.005;  ///< [m]
inline constexpr double kPlacementYaw = 5.0 * kPi / 180.0;

struct GraspPrediction {
  double reach_miss = 0.0;   ///< by which the pads stop short of the object [m]; 0: they reach it
  double room = 0.0;         ///< of the open digits beside the object, at worst; negative where one
                             ///< would be inside it [m]
  double needed_room = 0.0;  ///< [m]
  int num_digits = 0;        ///< that grasp
  int num_touching = 0;      ///< of these, when the hand has closed
  bool thumb_touches = false;  ///< the opposing digit is one of them
  bool opposes = false;        ///< normals of the thumb and the others oppose each other
  bool lifts = false;          ///< normals do not point up
  /** Of the contacts, thumb against the mean of the others, above the centre of mass [m]; what is
  pushed above it tips. */
  double contact_height = 0.0;
  bool palm_is_near = false;  ///< it may touch, and stops within 3.5 mm of the near face

  bool reaches() const { return reach_miss <= 0.0; }
  /** Closing brings the opposing digit and another to the object. */
  bool meets() const { return thumb_touches && num_touching >= 2; }
  bool is_clear() const { return room >= needed_room; }
  bool holds() const { return opposes && lifts && num_touching == num_digits; }
};

/** How promising a grasp is by geometry; larger is better. That it reaches the object and meets it
when it closes comes first, then that its development found it to hold what it had not met, then how
many of four conditions it keeps, then how low it meets the object: what is pushed above its centre
of mass tips. */
struct GraspRank {
  int meets = -1;
  bool has_held = false;
  int num_kept = 0;    ///< clear of it; forces that hold; every digit meets it; the palm near
  double depth = 0.0;  ///< of the contacts below the object's centre of mass [m]

  bool operator>(const GraspRank& other) const {
    return std::tie(meets, has_held, num_kept, depth) >
           std::tie(other.meets, other.has_held, other.num_kept, other.depth);
  }
};
GraspRank RankGrasp(const Grasp& grasp, const GraspPrediction& prediction);

/** @pre the object has its distance field. */
GraspPrediction PredictGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** Whether the grasp reaches the object and is clear of it even if the object filled its bounding
box; needs no distance field. Such a grasp need not be fitted. */
bool ClearsBoundingBox(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** The grasp as the hand does it on this object: its pre-grasp opened, along the line from target
to pre-grasp and within the joints' limits, until the way is clear. Where nobody says from where the
hand comes, it comes by the rule's way (placement.h), or by the other one if only that is clear,
reaches and meets it, or if only there the palm of a grasp that holds bears with the digits; where
neither is clear, from where the palm comes near. Itself when it is clear as it is, was made for an
object, or when nothing helps. @pre as PredictGrasp. */
Grasp FitGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** The grasp from another place than the rule's, which it then brings: its pre-grasp opened by the
share `opening` of the way from target to pre-grasp, and further until the way is clear. As it is
with that opening when nothing helps. @pre as PredictGrasp. */
Grasp FitGraspAt(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                 const PlaceChange& change, double opening);

}  // namespace graspbench
