#pragma once
/** @file
Force on each tactile element of a hand at one instant, computed from its contacts, whether or not
the trial uses sensed touch. As in touch_sensors.h before any response, a contact is spread over the
disc on which it presses. A contact outside every sensed surface presses on no element. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/physics/world.h"
#include "core/trial/touch_sensors.h"

namespace graspbench {

/** Returns the force on the cell of each element of the hand's skin [N].
@param q  joint positions of the hand (num_joints) [rad].   @pre the hand has a skin. */
std::vector<double> CalcTaxelForces(const Hand& hand, const SensorConfig& config, const Pose& X_WH,
                                    const Eigen::VectorXd& q,
                                    const std::vector<HandContact>& contacts);

}  // namespace graspbench
