#include "core/trial/taxel_forces.h"

namespace graspbench {

std::vector<double> CalcTaxelForces(const Hand& hand, const SensorConfig& config, const Pose& X_WH,
                                    const Eigen::VectorXd& q,
                                    const std::vector<HandContact>& contacts) {
  std::vector<double> forces(hand.skin->elements.size(), 0.0);
  if (contacts.empty()) return forces;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  for (const HandContact& contact : contacts) {
    const SensedSurface* surface = hand.skin->FindSurface(contact.link);
    if (!surface) continue;
    const Pose X_LW = (X_WH * X_HL[static_cast<size_t>(contact.link)]).inverse();
    SpreadForce(*surface, ProjectOntoSurface(hand, contact.link, X_LW * contact.p_WC),
                contact.normal_force, config.patch_radius, forces);
  }
  return forces;
}

}  // namespace graspbench
