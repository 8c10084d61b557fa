#pragma once
/** @file
Pose of the hand relative to the object. It is computed unless the grasp was made for this object
and has its own placement (grasp_file.h).

The hand knows the object's sizes and its nominal pose (frame O: centre of its bounding box, resting
on the table). With q(s) the linear closing from pre-grasp to target,

    s*   the first s at which thumb pad and mean of the other pads are an object's width apart
    G    the grasp centre, midway between the two at s*

G is placed over the object's centre at grasp height h_g. The opposition axis (thumb to fingers) is
turned by alpha from the object's long axis. The approach direction (the palm's normal tilted
towards the fingertips) points straight down. For precision and pinch grasps

    h_g = max(9 mm, min(height / 2, height - 8 mm)),

so that the pads clear the table. A grasp whose palm may touch is instead placed with the palm at
`palm_gap` from the object. No sphere of the hand comes nearer to the table than kTableClearance
while the hand closes to s*. Objects thinner than 9 mm are picked off the table: for them this holds
at s* only.

The open hand comes from afar along the approach. It stops where its palm would come nearer to the
object than 3 mm (0 for a palm that may touch), or where another link would touch the object.
Fingertips may brush the object on the approach path, but do not end inside it. If the hand had to
stop before its pads pass the object's near face by 3 mm, the grasp does not reach the object.

In an approach from the side, the approach direction is horizontal along the object's width, the
flexion axis of the fingers vertical and the grasp centre at half height. The strategy is the same;
only position and orientation differ. Session, object and grasp may choose or exclude it
(core/shape/grasp_object.h). By default it is used by grasps that seek the palm, and by grasps whose
palm may touch on objects taller than the fingers reach.

The thesis gives d and alpha and says that p is computed; the rest is proposed by graspbench. */

#include <Eigen/Core>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** Clearance that the hand keeps from the table while it closes [m]. */
inline constexpr double kTableClearance = 0.0005;

/** The posture at closing parameter s in [0, 1], coupled joints included. */
Eigen::VectorXd CalcClosingPosture(const Hand& hand, const Grasp& grasp, double s);

/** Unit direction, in H, in which the hand approaches an object from above: the palm's normal,
turned about the fingers' flexion axis by `tilt` towards the fingertips. */
Eigen::Vector3d CalcApproachDirection(const Hand& hand, double tilt);

/** Distance of the opposing pad from the mean of the others in the pre-grasp, seen along the
approach from above [m]. Wider objects do not fit. */
double CalcPreGraspWidth(const Hand& hand, const Grasp& grasp);

/** Computes the placement for the approach that the grasp chooses.
@param object_size  length, width, height of the object at rest [m], all > 0.
@param p_OOcm  centre of mass [m]. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const Eigen::Vector3d& object_size,
                        const Eigen::Vector3d& p_OOcm);

/** Computes the placement for the object's approach, or the grasp's if the object chooses none. The
hand stops before the object's surface (its distance field). A placement of the grasp is returned
unchanged. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object);

/** Deviation from the computed placement. */
struct PlaceChange {
  double yaw = 0.0;    ///< rotation about the vertical of the axes of the computation [rad]
  double rise = 0.0;   ///< upwards [m]
  double along = 0.0;  ///< along the first of the rotated axes [m]
};

/** Computes the placement in axes rotated by the yaw. There the object's sizes are those of its
bounding box, and a hand from the side comes along the second axis. The hand is then moved, raised
off the table and stopped before the object. A placement of the grasp is ignored. */
Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const PlaceChange& change);

/** Coordinate along `approach_W` at which a plane that advances along it first meets the object's
surface, for the object at its nominal pose [m]. */
double CalcNearFace(const GraspObject& object, const Eigen::Vector3d& approach_W);

/** The placement of the grasp with the hand rotated about the object's centre by the vector
`turn_W` [rad] and then shifted by `shift_W` [m]; the approach is unchanged. A hand that was moved
is raised off the table and stopped before the object by the rules above. @pre the grasp has a
placement. */
Placement MovePlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const Eigen::Vector3d& shift_W, const Eigen::Vector3d& turn_W);

/** Distance by which the pads miss the position where they would hold the object [m]; 0 if they
reach it. @param placement  a result of CalcPlacement. */
double CalcReachMiss(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const Placement& placement);

/** Signed distance of a point in O from a box of this size centred at O [m]. */
double CalcBoxDistance(const Eigen::Vector3d& size, const Eigen::Vector3d& p_O);

/** The placement as if the object filled its bounding box; needs no distance field. If it reaches
the box, it also reaches the object inside. */
Placement CalcBoxPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object);

}  // namespace graspbench
