#include "core/hand/import/foreign_hand.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/text/text.h"

namespace graspbench {

void FindDecoration(const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  // By link: a representative link of its body.
  std::vector<size_t> body(hand.links.size());
  std::iota(body.begin(), body.end(), size_t{0});
  const auto find = [&](size_t link) {
    while (body[link] != link) link = body[link] = body[body[link]];
    return link;
  };
  for (const ForeignJoint& joint : hand.joints) {
    if (joint.kind != ForeignJoint::Kind::kFixed) continue;
    body[find(static_cast<size_t>(joint.child))] = find(static_cast<size_t>(joint.parent));
  }
  std::vector<const ForeignLink*> touching(hand.links.size());  // by body
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const ForeignLink*& first = touching[find(i)];
    if (!first && !hand.links[i].collisions.empty()) first = &hand.links[i];
  }
  for (size_t i = 0; i < hand.links.size(); ++i) {
    ForeignLink& link = hand.links[i];
    const ForeignLink* other = touching[find(i)];
    if (!other || !link.collisions.empty() || link.visuals.empty()) continue;
    link.is_decoration = true;
    problems.Warn(file, link.line,
                  "link \"" + link.name + "\" has a picture and no collision shape, and \"" +
                      other->name +
                      "\", to which it is fixed, has some: its picture is decoration, left out of "
                      "contact" +
                      (link.weights.empty() ? " and mass" : ""));
  }
}

bool AreErrorsLocal(const ForeignHand& hand, const Diagnostics& problems) {
  std::vector<bool> is_local(problems.entries().size(), false);
  for (const ForeignLink& link : hand.links) {
    for (const size_t k : link.told) is_local[k] = true;
  }
  for (const ForeignJoint& joint : hand.joints) {
    for (const size_t k : joint.told) is_local[k] = true;
  }
  for (size_t k = 0; k < is_local.size(); ++k) {
    if (problems.entries()[k].severity == Severity::kError && !is_local[k]) return false;
  }
  return true;
}

void ResolveMimics(const std::vector<NamedMimic>& mimics, const std::string& what,
                   const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  std::map<int, NamedMimic> own;  // by joint
  const auto drop = [&](const NamedMimic& mimic, const std::string& why) {
    problems.Warn(file, mimic.line,
                  "joint \"" + hand.joints[mimic.joint].name + "\": " + what + " " + why +
                      "; the joint gets a drive of its own");
  };
  std::map<std::string, int> index;
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    index.emplace(hand.joints[j].name, static_cast<int>(j));
  }
  for (const NamedMimic& mimic : mimics) {
    const auto found = index.find(mimic.follows);
    if (found == index.end()) {
      drop(mimic, "of \"" + mimic.follows + "\", which is no joint");
    } else if (found->second == mimic.joint) {
      drop(mimic, "of itself");
    } else if (hand.joints[found->second].kind == ForeignJoint::Kind::kFixed) {
      drop(mimic, "of \"" + mimic.follows + "\", which does not move");
    } else if (mimic.ratio == 0.0 || std::abs(mimic.ratio) > 100.0) {
      drop(mimic, "has a multiplier of " + FormatSignificant(mimic.ratio, 3));
    } else {
      own.emplace(mimic.joint, mimic);
    }
  }
  for (const NamedMimic& mimic : mimics) {
    if (own.count(mimic.joint) == 0) continue;
    ForeignMimic resolved;
    resolved.joint = mimic.joint;
    size_t steps = 0;  // the leader may follow a third joint
    while (own.count(resolved.joint) != 0 && steps++ <= own.size()) {
      const NamedMimic& next = own.at(resolved.joint);
      resolved.joint = index.at(next.follows);
      resolved.offset += resolved.ratio * next.offset;
      resolved.ratio *= next.ratio;
    }
    if (steps > own.size()) {
      drop(mimic, "goes round in a ring");
      own.erase(mimic.joint);
    } else {
      hand.joints[mimic.joint].mimic = resolved;
    }
  }
}

void RaiseToBounds(const ForeignHand& hand, ForeignLink& link) {
  const bool is_world = hand.world >= 0 && &link == &hand.links[static_cast<size_t>(hand.world)];
  if (is_world || !link.inertia || (hand.least_mass == 0.0 && hand.least_moment == 0.0)) return;
  link.inertia->mass = std::max(link.inertia->mass, hand.least_mass);
  if (!link.inertia->I_I.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(link.inertia->I_I);
  const Eigen::Matrix3d R = principal.eigenvectors();
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(hand.least_moment);
  link.inertia->I_I = R * moments.asDiagonal() * R.transpose();
}

void FixJoint(ForeignHand& hand, int index, double q) {
  ForeignJoint& joint = hand.joints[static_cast<size_t>(index)];
  if (joint.kind == ForeignJoint::Kind::kPrismatic) joint.X_PJ.translate(q * joint.axis);
  if (joint.kind == ForeignJoint::Kind::kRevolute) {
    joint.X_PJ.rotate(Eigen::AngleAxisd(q, joint.axis));
  }
  joint.kind = ForeignJoint::Kind::kFixed;
  joint.mimic.reset();
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const auto mimic = hand.joints[j].mimic;
    if (mimic && mimic->joint == index) {
      FixJoint(hand, static_cast<int>(j), mimic->offset + mimic->ratio * q);
    }
  }
}

}  // namespace graspbench
