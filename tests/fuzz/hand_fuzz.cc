// Any bytes as hand.urdf and hand.yaml, parted by a line "%%%%": problems, or a hand that stands.

#include <string>

#include "core/hand/hand.h"
#include "core/hand/load_hand.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  const std::string part = "\n%%%%\n";
  const size_t at = bytes.find(part);
  const std::string urdf = bytes.substr(0, at);
  const std::string yaml = at == std::string::npos ? "" : bytes.substr(at + part.size());
  Diagnostics problems;
  const Hand hand = ParseHand(urdf, yaml, "no-such-folder", problems);
  if (problems.num_errors() > 0) return;
  Eigen::VectorXd q = Eigen::VectorXd::Constant(hand.num_joints(), 0.1);
  ApplyCoupling(hand, q);
  for (const Pose& X_HL : CalcLinkPoses(hand, q)) {
    GRASPBENCH_DEMAND(X_HL.matrix().allFinite(), "a link's pose is not finite");
  }
  for (const ContactSphere& sphere : hand.contact_spheres) {
    GRASPBENCH_DEMAND(sphere.p_LS.allFinite() && sphere.radius > 0.0,
                      std::to_string(sphere.radius));
  }
}

}  // namespace graspbench
