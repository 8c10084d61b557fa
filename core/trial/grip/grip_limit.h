#pragma once
/** @file
With how much the drives of a hand press in a grasp: an estimate, which a grasp may exceed, and a
bound, which none does. Both are of the force of each digit that does not oppose the others [N];
infinite where closing moves no digit. */

#include "core/grasp/standard_grasp.h"

namespace graspbench {

/** The estimate: of the weakest digit at its pad in the target posture, along the pad's way there;
the drive that reaches its torque limit first decides. The digit that opposes n others counts with
its own over n, since it bears their sum; not where the palm may touch, which bears it too. Contacts
nearer to the palm have shorter levers, and more force. */
double CalcPadGrip(const Hand& hand, const Grasp& grasp);

/** The bound: of the weakest digit, the sum over its joints that close of

    torque limit / least lever,    least lever = min over balls of max(|axis to centre|, radius)

with the balls of the surface that no closing joint further out moves: for normal forces f_i with
levers r_i,j about joint j, sum_i f_i <= sum_j limit_j / min r_j. A place nearer to an axis than the
ball's radius is on the joint itself. Of two digits without a palm the opposing one counts, too:
each bears the other. Blind to: forces along a link, as on its tip; an object wedged by friction. */
double CalcGripBound(const Hand& hand, const Grasp& grasp);

}  // namespace graspbench
