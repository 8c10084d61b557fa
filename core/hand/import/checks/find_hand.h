#pragma once
/** @file
Locates the hand in a description: in an arm, a scene with a table and a door, or a rig with two
hands, only one part is a hand.

A chain ends at a link that moves or is a fixed jaw, has a shape, and carries no further such link.
The palm is the lowest link that all chains have in common. The world of a scene is not a palm.
Neither is a link that joins parts which are hands themselves (at least two chains, all within 0.5
m) and lie more than 0.2 m apart. If exactly one of these parts is a hand, it is selected; the rest
is left out and reported. If there is none, or several without a named palm, an error lists what was
found. The same holds for a second hand that is fixed rigidly to the palm of the first: 0.2 m away,
or with the same number of digits and a thumb like it. The link to which a palm is fixed is taken as
part of the palm. For a named palm it is cut off; without a name it is reported if it outweighs the
hand. */

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Tree of a foreign hand, from the root. */
struct ForeignTree {
  std::vector<int> joint_of;             ///< by link: joint above it; -1: the root
  std::vector<std::vector<int>> joints;  ///< by link: joints below it
  std::vector<int> order;                ///< links, parents first
};
ForeignTree MakeForeignTree(const ForeignHand& foreign);

/** Finds a fixed jaw, marks its joint and reports it. A jaw that is fixed to the palm is a digit if
only one joint moves, and if it is the only link with a shape that is fixed to the moving jaw's
parent. This parent must have a shape, too. @param is_asked  by link: whether the joint above it
is considered. @param has_body  as in FindHand. */
void MarkFixedJaw(const ForeignTree& tree, const std::vector<bool>& has_body,
                  const std::vector<bool>& is_asked, const std::string& file, Diagnostics& problems,
                  ForeignHand& foreign);

struct HandCandidate {
  int palm = -1;              ///< index of the foreign link; -1: none, an error is reported
  int top = -1;               ///< highest link that belongs to the hand
  std::vector<int> left_out;  ///< links below it that start other hands, fixed to a named palm
  /** Link to which a named palm is fixed but which is not part of it: no digit hangs there; -1:
  none. */
  int carrier = -1;
  int root = -1;  ///< if there is a carrier: the link that is fixed to it
};

/** @param has_body  by link: it or one of its descendants has a shape. @param palm  name of the
palm's link; empty: to be found. */
HandCandidate FindHand(const ForeignHand& foreign, const ForeignTree& tree,
                       const std::vector<bool>& has_body, const std::string& palm,
                       const std::string& file, Diagnostics& problems);

}  // namespace graspbench
