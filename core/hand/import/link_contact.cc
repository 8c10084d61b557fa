#include "core/hand/import/link_contact.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/contact_fit.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/shapes/pack_balls.h"

namespace graspbench {
namespace {

constexpr double kBlocks = 0.0005;          // [m]
constexpr double kRootOfFreeDigit = 0.025;  // [m] of a joint from the digit's first one
constexpr int kPostures = 400;

/** Postures that fill the joints' ranges evenly (Kronecker sequence), starting with their ends. */
std::vector<Eigen::VectorXd> ListPostures(const Hand& hand, const std::vector<int>& joints) {
  std::vector<Eigen::VectorXd> postures;
  const auto add = [&](auto&& choose) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
    for (size_t i = 0; i < joints.size(); ++i) {
      const HandJoint& joint = hand.joints[static_cast<size_t>(joints[i])];
      q[joints[i]] = joint.lower + (joint.upper - joint.lower) * choose(i);
    }
    ApplyCoupling(hand, q);
    postures.push_back(q);
  };
  for (size_t corner = 0; corner < (size_t{1} << std::min<size_t>(joints.size(), 4)); ++corner) {
    add([&](size_t i) { return i < 4 ? static_cast<double>(corner >> i & 1) : 0.5; });
  }
  for (int k = 1; k <= kPostures; ++k) {
    add([&](size_t i) {
      const double step = std::sqrt(static_cast<double>(i == 0 ? 2 : i == 1 ? 3 : 2 * i + 1));
      return k * step - std::floor(k * step);
    });
  }
  return postures;
}

/** Depth of the link's shapes in the palm's while the joints that lead to it move [m]. */
double CalcDepth(const ImportedHand& imported, int link, const std::vector<int>& joints) {
  Hand pair = imported.hand;  // with the capsules of these two links only
  pair.capsules.clear();
  pair.contact_spheres.clear();
  for (const CollisionShape& shape : imported.shapes) {
    if (shape.link == pair.palm_link || shape.link == link) AddContact(shape, false, pair);
  }
  const std::vector<CapsulePair> meeting = FindCapsulePairs(pair);
  double depth = 0.0;
  for (const Eigen::VectorXd& q : ListPostures(pair, joints)) {
    const std::vector<Pose> X_HL = CalcLinkPoses(pair, q);
    for (const CapsulePair& capsules : meeting) {
      depth = std::max(depth, -CalcCapsuleGap(pair, capsules, X_HL));
    }
  }
  return depth;
}

}  // namespace

void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems) {
  Hand& hand = imported.hand;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  for (const Digit& digit : hand.digits) {
    std::vector<int> joints;
    for (const int link : digit.links) {
      if (hand.links[link].joint >= 0) joints.push_back(hand.links[link].joint);
      const double from_root =
          (X_HL[link].translation() - X_HL[digit.links.front()].translation()).norm();
      if (from_root > kRootOfFreeDigit || joints.empty()) break;
      const double depth = CalcDepth(imported, link, joints);
      if (depth <= kBlocks) continue;
      hand.apart.emplace_back(hand.palm_link, link);
      problems.Warn(file, 0,
                    fmt::format("link \"{}\" would enter the palm by up to {:.1f} mm within the "
                                "limits of joint \"{}\"; the two never touch each other",
                                hand.links[link].name, MmFromM(depth),
                                hand.joints[hand.links[link].joint].name));
    }
  }
}

namespace {

bool IsTip(const Hand& hand, int link) {
  return std::any_of(hand.digits.begin(), hand.digits.end(),
                     [&](const Digit& digit) { return digit.distal_link == link; });
}

/** Balls of the link, as the loader makes them from its shapes. */
std::vector<ContactSphere> MakeBalls(const ImportedHand& imported, int link, bool is_pad) {
  Hand alone;
  for (const CollisionShape& shape : imported.shapes) {
    if (shape.link == link) AddContact(shape, is_pad, alone);
  }
  return alone.contact_spheres;
}

}  // namespace

void CoverLinks(const LinkSolids& solids, int num_points, ImportedHand& imported) {
  const Hand& hand = imported.hand;
  for (int link = 0; link < static_cast<int>(hand.links.size()); ++link) {
    if (!solids[static_cast<size_t>(link)]) continue;
    const LinkSolid& solid = *solids[static_cast<size_t>(link)];
    if (solid.boundary().empty()) continue;
    const auto is_fitted = [&](const CollisionShape& shape) {
      return shape.link == link && shape.is_fitted;
    };
    auto& shapes = imported.shapes;
    const auto fitted = std::find_if(shapes.begin(), shapes.end(), is_fitted);
    std::vector<FittedCapsule> capsules;
    if (fitted != shapes.end()) {
      shapes.erase(std::remove_if(fitted, shapes.end(), is_fitted), shapes.end());
      capsules = InscribeCapsules(solid);
    }
    const bool is_tip = IsTip(hand, link);
    const std::vector<Ball> balls = PackBalls(solid, MakeBalls(imported, link, is_tip),
                                              is_tip ? kSmallestPadBall : 0.0, num_points);
    for (const FittedCapsule& capsule : capsules) {
      CollisionShape& shape = shapes.emplace_back(MakeCapsuleShape(capsule));
      shape.link = link;
      shape.is_self_contact = true;
    }
    for (const Ball& ball : balls) {
      CollisionShape& shape = shapes.emplace_back();
      shape.link = link;
      shape.X_LS = MakePose(ball.centre);
      shape.size.setConstant(2.0 * ball.radius);
      shape.is_cover = true;
    }
    std::string& note = imported.notes[static_cast<size_t>(link)];
    note += (note.empty() ? "" : "\n") + hand.links[static_cast<size_t>(link)].name + ": " +
            FormatCount(static_cast<int64_t>(balls.size()), "ball") + " inside its surface, " +
            FormatCount(static_cast<int64_t>(capsules.size()), "capsule") +
            " for contact with the hand itself";
  }
  // Balls and capsules are not drawn.
  const bool is_unseen = imported.visuals.empty() &&
                         std::any_of(imported.shapes.begin(), imported.shapes.end(),
                                     [](const CollisionShape& s) { return s.is_self_contact; });
  for (int link = 0; is_unseen && link < static_cast<int>(hand.links.size()); ++link) {
    for (const TriMesh& solid : imported.solids[static_cast<size_t>(link)]) {
      ImportedHand::Visual& seen = imported.visuals.emplace_back();
      seen.link = link;
      seen.visual.mesh = solid;
      seen.visual.name = "touch";
    }
  }
}

void MeasureLinks(const std::string& file, bool accepts_coarse, const LinkSolids& solids,
                  ImportedHand& imported, Diagnostics& problems) {
  Hand hand = imported.hand;
  for (const CollisionShape& shape : imported.shapes) {
    AddContact(shape, IsTip(hand, shape.link), hand);
  }
  imported.fits = MeasureContact(hand, solids);
  for (const ContactFit& fit : imported.fits) {
    const bool is_tip = IsTip(hand, hand.FindLink(fit.link));
    const bool is_full = static_cast<size_t>(fit.num_balls) >= kMostBalls;  // so holes remain
    const auto count_sink = [&](const ContactError& s) { return is_full ? s.most : s.at_95; };
    const double all = std::max(fit.out.most, count_sink(fit.sink));
    const double palmar = std::max(fit.palmar_out.most, count_sink(fit.palmar_sink));
    const std::string told = "link \"" + fit.link + "\": " + DescribeContactError(fit);
    if ((is_tip ? all : palmar) > kMostContactError && !accepts_coarse) {
      problems.Fail(
          file, 0,
          told + "; expected 5 mm at most on the palmar side and on tips. " +
              (is_full
                   ? fmt::format("A link may have {} balls, too few for this surface.", kMostBalls)
                   : "Is its mesh whole?") +
              " --coarse-contact takes it as it is");
    } else if (all > kFairContactError) {
      problems.Warn(file, 0, told);
    }
    if (fit.self_contact < kFairSelfContact) {
      problems.Warn(file, 0, "link \"" + fit.link + "\": " + DescribeSelfContact(fit));
    }
  }
}

}  // namespace graspbench
