#pragma once
/** @file
What the parts of a hand press on the object with, which share of a grip falls to each, and how
stiffly a digit presses when it closes. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/hand.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/world.h"

namespace graspbench {

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

}  // namespace graspbench
