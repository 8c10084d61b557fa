#pragma once
/** @file
Contacts and joints in a scene: marks over a picture, and the contact shapes of a hand.

A mark is a point at which hand and object touch, an arrow for the force on the object that ends
there, and the friction cone that the arrow may not leave. The cone is green if the contact is at
rest (static friction) and blue if it slides (dynamic friction). A contact that failed has a large
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
  double mu = 0.0;                                    ///< in the contact's state
  bool is_sliding = false;
  bool has_failed = false;
};

/** Adds the marks to a scene. The cone opens against nhat_W, with its tip at the contact and the
half angle atan(mu); there is none without friction.
@param length_per_force  scale of the arrows [m/N]. */
void AddContactMarks(const std::vector<ContactMark>& contacts, double length_per_force,
                     Scene* scene);

/** Adds the contact shapes of a hand to a scene: the balls that touch objects and table, and the
capsules inside them by which links touch each other. Balls of links with a pad have another colour.

A capsule is drawn slightly thinner than it is, so that balls of the same radius are visible.
@pre q has num_joints positions [rad], [m]. */
void AddContactShapes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene);

/** Adds arrows along the joint axes, in front of everything that is not a mark. Joints with their
own drive are red, joints that follow another are blue. A joint turns right-handed about its arrow,
or slides along it. @pre q has num_joints positions [rad], [m]. */
void AddJointAxes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene);

}  // namespace graspbench
