#pragma once
/** @file
Where in a description the hand is: of an arm, a scene with a table and a door, or a rig of two
hands only one part is one.

A chain ends at a link that moves, or is a fixed jaw, has a shape and carries no further such link.
The palm is the lowest link that all chains have in common. The world of a scene is no palm, nor is
a link where parts meet that are hands themselves (two chains at least, all within 0.5 m) and lie
more than 0.2 m apart. Of such parts the one hand is taken, the rest is left out and reported; none,
or several without a palm named, is an error that lists what was found. So it is where a second hand
is fixed to the palm of one without a link between: 0.2 m away, or with as many digits and a thumb
like it. What a palm is fixed to is taken as a part of it; a palm that is named is cut from it, and
without a name one that outweighs the hand is reported. */

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** A foreign hand's tree, from the root down. */
struct ForeignTree {
  std::vector<int> joint_of;             ///< by link; -1: the root
  std::vector<std::vector<int>> joints;  ///< by link: those that hang on it
  std::vector<int> order;                ///< links, parents first
};
ForeignTree MakeForeignTree(const ForeignHand& foreign);

/** A jaw that is fixed to the palm is a digit where only one joint moves, and where one link alone
with a shape is fixed to the link that carries it, which has a shape, too. Its joint is marked and
reported. @param is_asked  by link: the joint above it counts. @param has_body  as of FindHand. */
void MarkFixedJaw(const ForeignTree& tree, const std::vector<bool>& has_body,
                  const std::vector<bool>& is_asked, const std::string& file, Diagnostics& problems,
                  ForeignHand& foreign);

struct HandCandidate {
  int palm = -1;              ///< foreign link; -1: none, an error is reported
  int top = -1;               ///< the highest link that belongs to it
  std::vector<int> left_out;  ///< links below it: other hands that are fixed to a named palm
  /** What a named palm is fixed to without being a part of it: no digit hangs there; -1: nothing. */
  int carrier = -1;
  int root = -1;  ///< then: the link that is fixed to the carrier
};

/** @param has_body  by link: it or what hangs on it has a shape. @param palm  name of the palm's
link; empty: to be found. */
HandCandidate FindHand(const ForeignHand& foreign, const ForeignTree& tree,
                       const std::vector<bool>& has_body, const std::string& palm,
                       const std::string& file, Diagnostics& problems);

}  // namespace graspbench
