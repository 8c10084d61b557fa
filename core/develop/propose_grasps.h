#pragma once
/** @file
Grasps from geometry alone. Many aims are sampled for a grasp type: which finger opposes the thumb,
the width, the distance from the palm, each side's share of the closing distance. For each aim the
pair of postures that fulfils the rules best is computed, and the squeeze beyond it.

The pads of the met posture would only touch. The target lies beyond it by the deflection of the
drives under the required grip. With f the force of a digit's pad towards the others and K the
drives' stiffness,

    q_target = q_met + K^-1 J^T f,

where each torque is at most half of its drive's limit. The thumb's f is the sum of the others'.
Source: statics; the rules are in posture_rules.h. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/develop/posture_rules.h"
#include "core/grasp/standard_grasp.h"

namespace graspbench {

struct ProposedGrasp {
  Grasp grasp;
  PostureAim aim;
  double grip = 0.0;    ///< grip force of the thumb with nothing between the pads [N]
  bool is_own = false;  ///< an existing grasp of the hand, not proposed by geometry
  double miss = 0.0;    ///< root of the summed squared residuals of the rules, plus a penalty for
                        ///< links inside each other
};

/** Decimals of degrees and millimetres in hand.yaml. */
inline constexpr int kGraspDecimals = 2;
/** Rounds postures and tilt as in hand.yaml, so that the tested grasp is the one that is read. */
void RoundGrasp(const Hand& hand, Grasp& grasp);

/** Whether the hand has enough digits: three for all finger precision and three finger special, two
for the others. */
bool CanDevelop(const Hand& hand, const GraspTaxon& taxon);

/** Returns the best `num_kept` of `num_drawn` samples, best first.
@param any_coupling  the rule of coupled joints is unknown: in half of the samples the joints that
others follow stay straight, where all rules agree. @pre CanDevelop. */
std::vector<ProposedGrasp> ProposeGrasps(const Hand& hand, const GraspTaxon& taxon, int num_drawn,
                                         int num_kept, bool any_coupling, RandomStream stream);

/** Returns the hand's own grasp of that name if it has the digits of its type, to be developed
further alongside the proposals. A power grasp is changed to seek the palm. */
std::optional<ProposedGrasp> ProposeOwn(const Hand& hand, const std::vector<Grasp>& grasps,
                                        const GraspTaxon& taxon);

/** Returns the target posture beyond `q_met`. @param grip  force of the opposing digit [N]. */
Eigen::VectorXd CalcSqueeze(const Hand& hand, const std::vector<std::string>& digits,
                            const Eigen::VectorXd& q_met, const Eigen::Vector3d& approach_H,
                            double grip);

}  // namespace graspbench
