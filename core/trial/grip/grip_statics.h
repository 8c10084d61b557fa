#pragma once
/** @file
What the parts of a hand press on the object with, which share of a grip falls to each, how stiffly a
digit presses when it closes, and with how much force its drives can. */

#include <Eigen/Core>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/world.h"

namespace graspbench {

/** Indices into Hand::digits, in the grasp's order. */
std::vector<int> ListGraspingDigits(const Hand& hand, const Grasp& grasp);

/** The part of each link: the place in `digits` of the digit that it belongs to, or, of all the rest
of the hand, digits.size(). */
std::vector<int> MapLinksToParts(const Hand& hand, const std::vector<int>& digits);

/** The contacts of one part of the hand, a digit or all the rest, taken together. */
struct PartLoad {
  double force = 0.0;  ///< sum of normal forces [N]
  /** Force on the object for a unit of `force`, normals and friction, as far as it does not bear
  the weight: a finger below the widest place of a ball holds it up as well. */
  Eigen::Vector3d push_W = Eigen::Vector3d::Zero();
  /** Generalised force on the part's joints that holds a unit of `force` (num_dofs) [m]. */
  Eigen::VectorXd torque;
};

/** @param parts  of each link, in [0, num_parts).  @param gravity_W  what is along it is left out.
*/
std::vector<PartLoad> CalcPartLoads(const std::vector<HandContact>& contacts,
                                    const std::vector<int>& parts, int num_parts,
                                    const HandDynamics& dynamics, const Eigen::Vector3d& gravity_W);

/** Fills in the forces of `free` parts that balance those of the others best: minimises
|sum_i forces_i push_i|, forces >= 0. Of three digits around a ball friction bears a good part: by
normals alone the thumb would be asked for less than half of what the two others leave to it.
@param free  one or two parts that touch. */
void BalanceForces(const std::vector<PartLoad>& loads, const std::vector<int>& free,
                   std::vector<double>& forces);

/** dF/ds of a digit that presses on something fixed: with J the load's torque and K the drives'
stiffness, (J . dq/ds) / (J K^-1 J) [N]. At least kLeastStiffness.
@param way  q_target - q_pre (num_joints). */
double CalcClosingStiffness(const Hand& hand, const HandDynamics& dynamics, const PartLoad& load,
                            const Eigen::VectorXd& way);
inline constexpr double kLeastStiffness = 1.0;  ///< [N]

/** With how much the drives of a hand press in a grasp: an estimate, which a grasp may exceed. Like
the bound below it is of the force of each digit that does not oppose the others [N]; infinite where
closing moves no digit.

It is that of the weakest digit at its pad in the target posture, along the pad's way there;
the drive that reaches its torque limit first decides. The digit that opposes n others counts with
its own over n, since it bears their sum; not where the palm may touch, which bears it too. Contacts
nearer to the palm have shorter levers, and more force. */
double CalcPadGrip(const Hand& hand, const Grasp& grasp);

/** The bound, which no grasp exceeds: of the weakest digit, the sum over its joints that close of

    torque limit / least lever,    least lever = min over balls of max(|axis to centre|, radius)

with the balls of the surface that no closing joint further out moves: for normal forces f_i with
levers r_i,j about joint j, sum_i f_i <= sum_j limit_j / min r_j. A place nearer to an axis than the
ball's radius is on the joint itself. Of two digits without a palm the opposing one counts, too:
each bears the other. Blind to: forces along a link, as on its tip; an object wedged by friction. */
double CalcGripBound(const Hand& hand, const Grasp& grasp);

}  // namespace graspbench
