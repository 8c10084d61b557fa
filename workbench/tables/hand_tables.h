#pragma once
/** @file
Hands for a person and for a program. */

#include <string>

#include "core/base/text/json.h"
#include "core/hand/hand.h"

namespace graspbench {

struct DescribedHands {
  Json json;          ///< {hands: [..]}
  std::string table;  ///< one row each
};
/** The hands that come with the program. */
DescribedHands DescribeHands();

/** Mass, digits, grasps, coupling, and limits and drive of each joint; angles in degrees. */
Json MakeHandJson(const Hand& hand);
/** The same as text with a table of the joints. */
std::string FormatHand(const Hand& hand);

}  // namespace graspbench
