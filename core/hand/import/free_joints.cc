#include "core/hand/import/free_joints.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/units.h"
#include "core/hand/self_contact.h"

namespace graspbench {
namespace {

constexpr double kBlocks = 0.0005;  // [m]
constexpr int kSteps = 24;          // of a joint's range
constexpr int kPieces = 8;          // of a shape that is cut

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

/** Pieces along the longest axis that cover the shape as contact has it; a ball, a disc: itself. */
std::vector<CollisionShape> Slice(const CollisionShape& shape) {
  int axis = 2;
  double ends = 0.0;  // that every piece has: a capsule's balls
  if (shape.kind == CollisionShape::Kind::kBox) {
    shape.size.maxCoeff(&axis);
  } else {
    ends = std::min(shape.size.x(), shape.size.z());
  }
  const double length = shape.size[axis] - ends;
  if (shape.kind == CollisionShape::Kind::kSphere || length <= 0.0) return {shape};
  std::vector<CollisionShape> pieces;
  for (int k = 0; k < kPieces; ++k) {
    CollisionShape& piece = pieces.emplace_back(shape);
    piece.size[axis] = ends + length / kPieces;
    piece.X_LS.translate(((k + 0.5) / kPieces - 0.5) * length * Eigen::Vector3d::Unit(axis));
  }
  return pieces;
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
    int num_kept = 0, num_own = 0;  // of this link
    for (const CollisionShape& shape : imported.shapes) {
      num_own += shape.link == index;
      if (blocks(shape)) continue;
      kept.push_back(shape);
      num_kept += shape.link == index;
    }
    if (num_kept == num_own) continue;
    const int num_left_out = num_own - num_kept;
    const double whole_depth = deepest;
    std::string taken = "left out of contact";
    if (num_kept == 0) {
      for (const CollisionShape& shape : imported.shapes) {
        if (shape.link != index) continue;
        for (const CollisionShape& piece : Slice(shape)) {
          if (blocks(piece)) continue;
          kept.push_back(piece);
          ++num_kept;
        }
      }
      taken += num_kept > 0 ? fmt::format("; cut along their length, {} pieces stay", num_kept)
                            : "; nothing of the link will touch";
      imported.notes[static_cast<size_t>(index)] +=
          num_kept > 0 ? "; guess: contact cut where it would meet the palm" : "; without contact";
    }
    problems.Warn(
        file, 0,
        fmt::format("link \"{}\": {} of its balls and capsules would meet the palm within "
                    "the limits of joint \"{}\", by up to {:.1f} mm; {}",
                    link.name, num_left_out, hand.joints[link.joint].name, MmFromM(whole_depth),
                    taken));
    imported.shapes = std::move(kept);
  }
}

}  // namespace graspbench
