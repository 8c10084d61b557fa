#pragma once
/** @file
Couplings and drives of the joints of a MuJoCo model.

    equality joint    a line, q = a + b q_other; for a polynomial of higher degree the best line
                      over the other's range, with its error reported; one joint alone: fixed
    equality tendon   the same, if there are two joints in all
    limited tendon    of two joints, with limits narrower than a quarter of the motion that either
                      joint gives it: also a coupling, with its play reported
    connect           a loop of links: cut, its passive joints coupled (close_loops.h)
    weld and others   reported, not read
    tendon, fixed     with an actuator: one drive for all of its joints. Two consecutive joints of a
                      finger with equal coefficients share it by the hand's coupling rule; others
                      move in the ratio of their coefficients, as with equal springs
    actuators         stiffness and damping of position actuators and of general ones with affine
                      bias; for all kinds the largest force; gears are included

Positions are displacements from the pose in the file, as in ForeignHand. */

#include <map>
#include <string>

#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_document.h"

namespace graspbench {

/** Pose of a body: its frame in a link of the hand. */
struct MjcfBody {
  int link = 0;
  Pose X_LB = Pose::Identity();
};

/** @param bodies  by name. @param hand  links, and joints with their own damping; receives mimics
and drives. */
void ReadMjcfCouplings(MjcfDocument& document, const std::map<std::string, MjcfBody>& bodies,
                       const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
