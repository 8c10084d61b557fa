#pragma once
/** @file
What a user should know before relying on a developed grasp. */

#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Sentences without the grasp's name; empty: nothing. A warning says that

    - more than 1 % of the trials failed numerically, which counts as not held;
    - less than a tenth of the check's shapes was held;
    - two digits held less than half of them and cannot oppose (FindOpposition).

The limits are proposed by graspbench. */
std::vector<std::string> ListDevelopmentWarnings(const Hand& hand, const DevelopedGrasp& developed);

/** Whether the pads of two digits can face each other, whatever the object: of two contacts a grasp
needs both normals within the friction cone about the line between them (Nguyen 1988), so with
friction mu

    max over both pads of  angle(n, line to the other pad)  <=  arctan(mu).

The postures of both digits are searched for the least such angle, pads 5 to 90 mm apart.

Angle that rubber on most things allows, a friction of 0.7; proposed by graspbench [rad]. */
constexpr double kLargestOppositionAngle = 0.61;

struct DigitOpposition {
  double angle = 0.0;     ///< the least that was found, of the pad that is turned away more [rad]
  double distance = 0.0;  ///< of the pads there [m]
};

/** Links are not kept out of each other: what is found is the best that joints and pads allow,
within some degrees. @pre indices of two digits of the hand. */
DigitOpposition FindOpposition(const Hand& hand, size_t a, size_t b);

/** Sentences on the pairs of the opposing digit and each other one of `digits` that cannot oppose:
"TH and FF cannot oppose: their pads face each other within 74 degrees at best, 35 would hold". */
std::vector<std::string> ListPairsApart(const Hand& hand, const std::vector<std::string>& digits);

}  // namespace graspbench
