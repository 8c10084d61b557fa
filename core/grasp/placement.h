#pragma once
/** @file
Where the hand stands to the object: computed, unless the grasp was made for this object and brings
its placement (grasp_file.h).

The hand knows the object's nominal pose (frame O: centre of its bounding box, resting on the table)
and its sizes. With q(s) the linear closing from pre-grasp to target,

    s*   the first s at which thumb pad and mean of the other pads are an object's width apart
    G    the grasp centre: midway between the two at s*

G is put over the object's centre at grasp height h_g, the opposition axis (thumb to fingers) is
turned by alpha from the object's long axis, the approach direction (the palm's normal tilted
towards the fingertips) points straight down. For precision and pinch

    h_g = max(9 mm, min(height / 2, height - 8 mm)),

so that the pads clear the table; a grasp whose palm may touch brings it to its `palm_gap` from the
object instead. No
sphere of the hand comes nearer to the table than kTableClearance while it closes to s*; what is
thinner than 9 mm is picked off the table, there it holds at s* only.

The open hand comes from afar along the approach and stops where its palm would come nearer to the
object than 3 mm (a palm that may touch: 0), or another link would meet it. Fingertips may brush the
object on the way, but do not end inside it. When the pads of a hand that had to stop do not pass
the object's near face by 3 mm, the grasp does not reach the object.

From the side the approach is horizontal, along the object's width, and the flexion axis of the
fingers vertical, the grasp centre at half height; the strategy is the same, only position and
orientation differ. Session, object and grasp may choose it or exclude it
(core/shape/grasp_object.h); when none does, it is for grasps that seek the palm, and for
those whose palm may touch on objects taller than the fingers reach.

All of this is proposed by graspbench: the thesis gives d and alpha, and that p is computed. */

#include <Eigen/Core>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** What the hand keeps from the table while it closes [m]. */
inline constexpr double kTableClearance = 0.0005;

/** The posture at closing parameter s in [0, 1], coupled joints included. */
Eigen::VectorXd CalcClosingPosture(const Hand& hand, const Grasp& grasp, double s);

/** Unit, in H: the direction in which the hand comes to an object from above; the palm's normal,
turned about the fingers' flexion axis by `tilt` towards the fingertips. */
Eigen::Vector3d CalcApproachDirection(const Hand& hand, double tilt);

/** Between the opposing pad and the mean of the others in the pre-grasp, seen along the approach
from above: what is wider does not fit [m]. */
double CalcPreGraspWidth(const Hand& hand, const Grasp& grasp);

/** As the grasp says it is approached.
@param object_size  length, width, height of the object as it rests [m], all > 0.
@param p_OOcm  its centre of mass [m]. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const Eigen::Vector3d& object_size,
                        const Eigen::Vector3d& p_OOcm);

/** The same, as the object says if it does, and stops before the object as it is (its distance
field). A placement that the grasp brings is left alone. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** What differs from the rule's place. */
struct PlaceChange {
  double yaw = 0.0;    ///< of the axes in which the rule places the hand, about the vertical [rad]
  double rise = 0.0;   ///< upwards [m]
  double along = 0.0;  ///< along the first of the turned axes [m]
};

/** By the same rule in axes that are turned by the yaw: the object's sizes are those of its bounding
box there, a hand from the side comes along the second of these axes. Then the hand is moved, raised
off the table and stopped before the object. What the grasp itself brings is ignored. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const PlaceChange& change);

/** Where the object's surface first meets a plane that comes along the approach: its coordinate
along `approach_W`, for the object at its nominal pose [m]. */
double CalcNearFace(const GraspObject& object, const Eigen::Vector3d& approach_W);

/** The placement that the grasp brings with the hand turned about the object's centre by the vector
`turn_W` [rad], then shifted by `shift_W` [m], the approach as it was. A hand that was moved is
raised off the table and stopped before the object by the rules above. @pre the grasp brings one. */
Placement MovePlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const Eigen::Vector3d& shift_W, const Eigen::Vector3d& turn_W);

/** How far the pads stay short of where they would hold the object [m]; 0: the placement reaches it.
@param placement  of CalcPlacement. */
double CalcReachMiss(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const Placement& placement);

/** Signed distance of a point in O from a box of this size about O [m]. */
double CalcBoxDistance(const Eigen::Vector3d& size, const Eigen::Vector3d& p_O);

/** A computed one as it would be if the object filled its bounding box; needs no distance field.
One that reaches the box implies that the object itself, which lies inside, is reached. */
Placement CalcBoxPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object);

}  // namespace graspbench
