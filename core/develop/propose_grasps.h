#pragma once
/** @file
Grasps from geometry alone: many aims drawn for a grasp type (which finger opposes the thumb, how
wide, how far from the palm, who does how much of the way), for each the pair of postures that keeps
the rules best, and the squeeze behind it.

The pads of the met posture would only touch. So the target goes beyond it by what the drives give
way under the wanted grip: with f the force of a digit's pad towards the others and K the drives'
stiffnesses,

    q_target = q_met + K^-1 J^T f,

each torque at most half of its drive's. The thumb's f is the sum of the others'. Source: statics;
the rules are in posture_rules.h. */

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
  double grip = 0.0;    ///< of the thumb with nothing between the pads [N]
  bool is_own = false;  ///< the hand had it before; geometry gave nothing
  double miss = 0.0;    ///< of the rules: root of the summed squared residuals; links inside
                        ///< each other add to it
};

/** Of degrees and millimetres in hand.yaml. */
inline constexpr int kGraspDecimals = 2;
/** Postures and tilt as hand.yaml will hold them, so that what was tried is what is read. */
void RoundGrasp(const Hand& hand, Grasp& grasp);

/** Whether the hand has the digits: three for all finger precision and the three finger special,
two for the rest. */
bool CanDevelop(const Hand& hand, const GraspTaxon& taxon);

/** The best `num_kept` of `num_drawn` draws, best first.
@param any_coupling  the rule of coupled joints is not known: half of the draws keep the joints
straight that others follow, where all rules agree. @pre CanDevelop. */
std::vector<ProposedGrasp> ProposeGrasps(const Hand& hand, const GraspTaxon& taxon, int num_drawn,
                                         int num_kept, bool any_coupling, RandomStream stream);

/** The hand's own grasp of that name, where its digits are those of the name, to be developed
further beside what geometry proposes. A power grasp is made to seek the palm. */
std::optional<ProposedGrasp> ProposeOwn(const Hand& hand, const std::vector<Grasp>& grasps,
                                        const GraspTaxon& taxon);

/** Target posture behind `q_met`. @param grip  of the opposing digit [N]. */
Eigen::VectorXd CalcSqueeze(const Hand& hand, const std::vector<std::string>& digits,
                            const Eigen::VectorXd& q_met, const Eigen::Vector3d& approach_H,
                            double grip);

}  // namespace graspbench
