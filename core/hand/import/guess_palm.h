#pragma once
/** @file
Which way the palm of an imported hand faces, and the middle of its surface.

The normal is guessed from where the pads of the open digits face and from where the digits meet
(palm_frame.h). Digits that close away from the others (outward_digits.h), and those whose limits
do not say to which side they close, tell nothing of it. It is an error, which asks for
--palm-normal, when no digit tells it, when no digit approaches the thumb, or when they meet more
than 20 mm behind the palm's surface; from 10 mm on it is reported. A normal that is given is taken;
one more than 60 degrees from the guess is reported. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @param given  in the palm's frame. @param facing  by digit: of its pad in H, at the open hand; 0:
not known. @pre the digits have tips and pads, one of them is the thumb. */
void GuessPalm(const std::string& file, const std::optional<Eigen::Vector3d>& given,
               const std::vector<Eigen::Vector3d>& facing, ImportedHand& imported,
               Diagnostics& problems);

}  // namespace graspbench
