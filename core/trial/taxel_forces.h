#pragma once
/** @file
What presses on each tactile element of a hand at an instant, from its contacts, whether or not the
trial went by them. As in touch_sensors.h before any response: a contact is spread over the disc that
it presses on; a contact beside every sensed surface presses on no element. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/physics/world.h"
#include "core/trial/touch_sensors.h"

namespace graspbench {

/** On the cell of each element of the hand's skin [N].
@param q  of the hand's joints (num_joints) [rad].   @pre the hand has a skin. */
std::vector<double> CalcTaxelForces(const Hand& hand, const SensorConfig& config, const Pose& X_WH,
                                    const Eigen::VectorXd& q,
                                    const std::vector<HandContact>& contacts);

}  // namespace graspbench
