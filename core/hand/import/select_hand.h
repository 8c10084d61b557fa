#pragma once
/** @file
Selects the part of a foreign description that is the hand. This happens before any mesh is read, so
meshes of other parts may be missing. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/checks/find_hand.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Fixes moving links at the end of a chain that have no shape: frames used by programs.
@param touches  by link: it has a shape. @returns by link: it or one of its descendants has. */
std::vector<bool> FixEmptyEnds(const std::vector<bool>& touches, const ForeignTree& tree,
                               const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Removes from `hand` everything that is not part of the hand. In a scene the only part with two
digits is selected (find_hand.h). Links above the palm are left out if more than two joints, an arm,
lead to it, or, for a named palm, if the mesh of one of them is missing. Errors: no hand, several
hands, more than 10 kg.
@param palm  name of the palm's link; empty: guessed from the tree, where the digits branch.
@param lacks_mesh  whether a mesh of a link is missing.
@returns the palm, as an index into the links that are kept; -1: an error is reported. */
int SelectHand(const std::string& palm, const std::function<bool(const ForeignLink&)>& lacks_mesh,
               const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
