#pragma once
/** @file
What ties and drives the joints of a MuJoCo model.

    equality joint    a line, q = a + b q_other; of a polynomial of higher degree the line nearest
                      over the other's range, its error told; of one joint alone: fixed
    equality tendon   the same, where there are two joints in all
    limited tendon    of two joints, with limits narrower than a quarter of what either joint moves
                      it: a tie as well, its play told
    connect           a loop of links: cut, its passive joints tied (close_loops.h)
    weld and others   told, not read
    tendon, fixed     with an actuator: one drive for all of its joints. Two joints of a finger, one
                      behind the other, with equal coefficients share it by the hand's coupling
                      rule; others move in the ratio of their coefficients, as of equal springs
    actuators         stiffness and damping of position and of general with an affine bias; of all
                      kinds the largest force; a gear counts

Positions are displacements from the file's place, as in ForeignHand. */

#include <map>
#include <string>

#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_document.h"

namespace graspbench {

/** Where a body is: its frame in a link of the hand. */
struct MjcfBody {
  int link = 0;
  Pose X_LB = Pose::Identity();
};

/** @param bodies  by name. @param hand  links, and joints with the damping of their own; gets
mimics and drives. */
void ReadMjcfCouplings(MjcfDocument& document, const std::map<std::string, MjcfBody>& bodies,
                       const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
