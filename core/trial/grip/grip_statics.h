#pragma once
/** @file
Statics of a grip: loads of the parts of a hand on the object, distribution of the grip force over
them, stiffness of a closing digit that presses, and the force that its drives can exert. */

#include <Eigen/Core>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/world.h"

namespace graspbench {

/** Returns indices into Hand::digits, in the grasp's order. */
std::vector<int> ListGraspingDigits(const Hand& hand, const Grasp& grasp);

/** Returns the part of each link: the index in `digits` of its digit, or digits.size() for the rest
of the hand. */
std::vector<int> MapLinksToParts(const Hand& hand, const std::vector<int>& digits);

/** The combined contacts of one part of the hand: a digit, or the rest of the hand. */
struct PartLoad {
  double force = 0.0;  ///< sum of normal forces [N]
  /** Force on the object per unit of `force`, normal and friction, without its component along
  gravity, which bears the weight: a finger below the widest section of a ball also holds it up. */
  Eigen::Vector3d push_W = Eigen::Vector3d::Zero();
  /** Generalised force on the part's joints that holds a unit `force` (num_dofs) [m]. */
  Eigen::VectorXd torque;
};

/** @param parts  by link, in [0, num_parts).  @param gravity_W  components along it are omitted. */
std::vector<PartLoad> CalcPartLoads(const std::vector<HandContact>& contacts,
                                    const std::vector<int>& parts, int num_parts,
                                    const HandDynamics& dynamics, const Eigen::Vector3d& gravity_W);

/** Sets the forces of the `free` parts that best balance those of the others: minimises
|sum_i forces_i push_i| subject to forces >= 0. Friction is included, since it bears much of the
load of three digits around a ball: with normals alone, the thumb's setpoint would be less than half
of what the two others exert on it.
@param free  one or two parts that touch. */
void BalanceForces(const std::vector<PartLoad>& loads, const std::vector<int>& free,
                   std::vector<double>& forces);

/** Closing stiffness dF/ds of a digit that presses on a fixed object [N], at least kLeastStiffness.
With J the load's torque and K the drives' stiffness, it is (J . dq/ds) / (J K^-1 J).
@param way  q_target - q_pre (num_joints). */
double CalcClosingStiffness(const Hand& hand, const HandDynamics& dynamics, const PartLoad& load,
                            const Eigen::VectorXd& way);
inline constexpr double kLeastStiffness = 1.0;  ///< [N]

/** Estimates the force that the drives of a hand exert in a grasp. A grasp may exceed it. Like the
bound below, it refers to each digit that does not oppose the others [N]; it is infinite if closing
moves no digit.

It is the force of the weakest digit at its pad in the target posture, along the direction in which
the pad moves there. The drive that reaches its torque limit first determines it. The digit that
opposes n others counts with its own force divided by n, since it bears their sum. It does not count
if the palm may touch, which bears part of that sum. Contacts nearer to the palm have shorter levers
and hence more force. */
double CalcPadGrip(const Hand& hand, const Grasp& grasp);

/** Upper bound of the force of any grasp. For the weakest digit, it is the sum over its closing
joints of

    torque limit / least lever,    least lever = min over balls of max(|axis to centre|, radius)

over the balls of the surface that no closing joint further out moves. For normal forces f_i with
levers r_i,j about joint j, sum_i f_i <= sum_j limit_j / min r_j. A point nearer to an axis than the
ball's radius is on the joint itself. With two digits and no palm the opposing digit counts too,
since each bears the other. Not covered: forces along a link, as on its tip; objects wedged by
friction. */
double CalcGripBound(const Hand& hand, const Grasp& grasp);

}  // namespace graspbench
