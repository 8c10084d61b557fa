#pragma once
/** @file
Which part of a foreign description is the hand. It is chosen before any mesh is read, so what is
left out need not exist. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/checks/find_hand.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Fixes moving links at the end of a chain that have nothing to touch with: frames for programs.
@param touches  by link. @returns by link: it or what hangs on it touches. */
std::vector<bool> FixEmptyEnds(const std::vector<bool>& touches, const ForeignTree& tree,
                               const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Removes from `hand` what is not of the hand. Of a scene the one part that has two digits is
taken (find_hand.h); links above the palm are left out when more than two joints, an arm, lead to
them. Errors: no hand or several; more than 10 kg.
Links above a palm that is named are left out, too, where the mesh of one is missing.
@param palm  name of the palm's link; empty: guessed from the tree: where the digits part.
@param lacks_mesh  true of a link whose mesh is missing.
@returns the palm, an index into the links that are kept; -1: an error is reported. */
int SelectHand(const std::string& palm, const std::function<bool(const ForeignLink&)>& lacks_mesh,
               const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
