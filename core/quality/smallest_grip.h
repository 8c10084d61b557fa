#pragma once
/** @file
The smallest force with which the digits of a grasp bear the object's weight:

    minimise F   so that contact forces exist with

        sum_i f_i + weight = 0            forces balance
        |sum_i p_i x f_i| <= tolerance    moments about the centre of mass too, axis by axis
        f_i in its cone                   friction, soft pads (wrench_space.h)
        sum of a digit's normal forces    at most F; of free ones (the digit that opposes the
                                          others, the palm) what balance asks

A linear program. For two opposed digits F = weight / (2 mu). Tolerance = 3 % of all normal force
times the object's radius, for the reason that holding_force.h gives. The cones' pyramids err on the
high side of F, by at most 8 %.

F is of the digit that presses most. Equal shares of F sum to more than uneven ones may need: of a
can that the Shadow Hand holds with 0.74 to 0.84 of the sum of such shares, the index presses with
1.4 to 1.6 F.

Source: Cloutier and Yang, J. Mechanisms Robotics 10:011004, 2018 (smallest sufficient contact
forces by linear and cone programs). Blind to: shares that stiff fingers take against the balance,
accelerations, drives. */

#include <optional>

#include "core/quality/holding_force.h"

namespace graspbench {

/** F [N]; none where no forces of these contacts bear the weight. `grasp.normal_forces` are not
looked at. @param is_free  of each contact: its digit's force counts for nothing.
@throws Error(kRange) where rounding hides the optimum (linear_program.h). */
std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free);

}  // namespace graspbench
