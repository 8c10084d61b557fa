#pragma once
/** @file
What of a hand touches: the balls that meet objects and table, those of links with a pad in another
colour, and the capsules by which links meet each other inside them. */

#include <Eigen/Core>

#include "core/hand/hand.h"
#include "core/render/scene.h"

namespace graspbench {

/** Adds them to a scene; a capsule is drawn a little thinner than it is, so that balls of the same
radius show. @pre q has num_joints positions [rad], [m]. */
void AddContactShapes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene);

}  // namespace graspbench
