#pragma once
/** @file
Warnings about the limited reliability of a developed grasp. */

#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Returns sentences without the grasp's name; empty: no warning. A warning states that

    - more than 1 % of the trials failed numerically, which counts as not held;
    - less than a tenth of the check's shapes was held;
    - two digits held less than half of them and cannot oppose (FindOpposition).

The limits are proposed by graspbench. */
std::vector<std::string> ListDevelopmentWarnings(const Hand& hand, const DevelopedGrasp& developed);

/** Whether the pads of two digits can face each other, whatever the object. A grasp with two
contacts needs both normals within the friction cone about the line between them (Nguyen 1988), so
with friction mu

    max over both pads of  angle(n, line to the other pad)  <=  arctan(mu).

The postures of both digits are searched for the least such angle, with pads 5 to 90 mm apart.

Largest angle, for a friction of 0.7 as of rubber on most materials; proposed by graspbench
[rad]. */
constexpr double kLargestOppositionAngle = 0.61;

struct DigitOpposition {
  double angle = 0.0;     ///< least angle found, of the pad that is turned away more [rad]
  double distance = 0.0;  ///< distance of the pads there [m]
};

/** Links may penetrate each other, so the result is the best that joints and pads allow, accurate
to some degrees. @pre indices of two digits of the hand. */
DigitOpposition FindOpposition(const Hand& hand, size_t a, size_t b);

/** Lists the pairs of the opposing digit and another one of `digits` that cannot oppose:
"TH and FF cannot oppose: their pads face each other within 74 degrees at best, 35 would hold". */
std::vector<std::string> ListPairsApart(const Hand& hand, const std::vector<std::string>& digits);

}  // namespace graspbench
