#include "core/hand/import/free_joints.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/units.h"
#include "core/hand/self_contact.h"

namespace graspbench {
namespace {

constexpr double kBlocks = 0.0005;  // [m]
constexpr int kSteps = 24;          // of a joint's range

/** How deep `shape` gets into the palm while the joint of its link moves through its range [m]. */
double CalcDepth(const ImportedHand& imported, const CollisionShape& shape) {
  Hand pair = imported.hand;  // with these two links' capsules alone
  pair.capsules.clear();
  pair.contact_spheres.clear();
  for (const CollisionShape& other : imported.shapes) {
    if (other.link == pair.palm_link) AddContact(other, false, pair);
  }
  AddContact(shape, false, pair);
  const std::vector<CapsulePair> meeting = FindCapsulePairs(pair);
  const int j = pair.links[shape.link].joint;
  const HandJoint& joint = pair.joints[j];
  Eigen::VectorXd q = Eigen::VectorXd::Zero(pair.num_joints());
  double depth = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    q[j] = joint.lower + (joint.upper - joint.lower) * k / kSteps;
    const std::vector<Pose> X_HL = CalcLinkPoses(pair, q);
    for (const CapsulePair& capsules : meeting) {
      if (pair.capsules[capsules.a].link == pair.capsules[capsules.b].link) continue;
      depth = std::max(depth, -CalcCapsuleGap(pair, capsules, X_HL));
    }
  }
  return depth;
}

}  // namespace

void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems) {
  const Hand& hand = imported.hand;
  for (int index = 0; index < static_cast<int>(hand.links.size()); ++index) {
    const HandLink& link = hand.links[index];
    const int digit = hand.FindDigitOfLink(index);
    if (link.parent != hand.palm_link || link.joint < 0 || digit < 0) continue;
    if (hand.digits[static_cast<size_t>(digit)].distal_link == index) continue;  // it grasps
    double deepest = 0.0;
    const auto blocks = [&](const CollisionShape& shape) {
      if (shape.link != index) return false;
      const double depth = CalcDepth(imported, shape);
      deepest = std::max(deepest, depth);
      return depth > kBlocks;
    };
    std::vector<CollisionShape> kept;
    for (const CollisionShape& shape : imported.shapes) {
      if (!blocks(shape)) kept.push_back(shape);
    }
    if (kept.size() == imported.shapes.size()) continue;
    problems.Warn(
        file, 0,
        fmt::format("link \"{}\": {} of its balls and capsules would meet the palm within "
                    "the limits of joint \"{}\", by up to {:.1f} mm; left out of contact",
                    link.name, imported.shapes.size() - kept.size(), hand.joints[link.joint].name,
                    MmFromM(deepest)));
    imported.shapes = std::move(kept);
  }
}

}  // namespace graspbench
