#pragma once
/** @file Small hands and objects made in code, with masses and shapes known in closed form. */

#include <memory>

#include "core/base/random.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/shape/primitives.h"

namespace graspbench {

inline GraspObject MakeTestObject(TriMesh mesh, double mass, double mu_s, double mu_d) {
  GraspObject object;
  object.mesh = std::move(mesh);
  object.field = std::make_shared<SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  object.mass_properties = CalcSolidMassProperties(object.mesh, mass);
  object.friction_static = mu_s;
  object.friction_dynamic = mu_d;
  return object;
}

/** A root that stays where it is put, far above everything: a world without a hand. */
inline Hand MakeBareHand() {
  Hand hand;
  HandLink root;
  root.name = "root";
  root.mass = 1.0;
  root.I_LLcm = 1e-3 * Eigen::Matrix3d::Identity();
  hand.links.push_back(root);
  return hand;
}

/** Appends a link of the given length along its z, turning about `axis` at X_PJ. */
inline void AddTestLink(Hand& hand, int parent, const Pose& X_PJ, const Eigen::Vector3d& axis,
                        double mass, double length) {
  HandLink link;
  link.name = "link" + std::to_string(hand.links.size());
  link.parent = parent;
  link.joint = hand.num_joints();
  link.X_PJ = X_PJ;
  link.axis = axis;
  link.mass = mass;
  link.p_LLcm = Eigen::Vector3d(0.0, 0.0, 0.5 * length);
  const double across = mass * length * length / 12.0 + 1e-7;
  link.I_LLcm = Eigen::Vector3d(across, across, 0.1 * across + 1e-7).asDiagonal();
  HandJoint joint;
  joint.name = "joint" + std::to_string(hand.num_joints());
  joint.link = static_cast<int>(hand.links.size());
  joint.lower = -100.0;
  joint.upper = 100.0;
  hand.links.push_back(link);
  hand.joints.push_back(joint);
}

/** A tree of `num_links` links with random frames, axes and inertia; branches are random too. */
inline Hand MakeRandomHand(int num_links, RandomStream& random) {
  Hand hand = MakeBareHand();
  for (int i = 0; i < num_links; ++i) {
    const auto parent = random.NextIndex(static_cast<int>(hand.links.size()));
    const Pose X_PJ = MakePose(
        MakeRotationRpy(random.NextUniform(-3, 3), random.NextUniform(-1, 1),
                        random.NextUniform(-3, 3)),
        0.05 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()));
    const Eigen::Vector3d axis =
        Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
    AddTestLink(hand, parent, X_PJ, axis, random.NextUniform(0.01, 0.1),
                random.NextUniform(0.02, 0.06));
    hand.links.back().p_LLcm += 0.01 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), 0);
  }
  return hand;
}

}  // namespace graspbench
