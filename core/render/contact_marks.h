#pragma once
/** @file
Contacts and joints in a scene: marks over a picture, and what of a hand can touch.

A mark is a point where hand and object touch, an arrow for the force on the
object that ends there, and the friction cone that the arrow may not leave, green where the contact
stands still (static friction) and blue where it slides (dynamic). A contact that failed has a large
magenta point. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/hand.h"
#include "core/render/scene.h"

namespace graspbench {

struct ContactMark {
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d nhat_W = Eigen::Vector3d::UnitZ();  ///< unit, into the object
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();  ///< on the object [N]
  double mu = 0.0;                                    ///< of its state
  bool is_sliding = false;
  bool has_failed = false;
};

/** Adds the marks to a scene. The cone opens against nhat_W, with its tip at the contact and the
half angle atan(mu); without friction there is none.
@param length_per_force  of the arrows [m/N]. */
void AddContactMarks(const std::vector<ContactMark>& contacts, double length_per_force,
                     Scene* scene);

/** What of a hand touches: the balls that meet objects and table, those of links with a pad in
another colour, and the capsules by which links meet each other inside them.

Adds them to a scene; a capsule is drawn a little thinner than it is, so that balls of the same
radius show. @pre q has num_joints positions [rad], [m]. */
void AddContactShapes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene);

/** Arrows along the axes of the joints, over all that is no mark: those with a drive of their own
red, those that follow another blue. A joint turns right-handed about its arrow, or slides along it.
@pre q has num_joints positions [rad], [m]. */
void AddJointAxes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene);

}  // namespace graspbench
