#include "datasets/grasps/shadow_layout.h"

#include <algorithm>
#include <array>

namespace graspbench {
namespace {

/** A joint in the frame of the one before it, all frames parallel at zero but the thumb's. */
struct PublishedJoint {
  Eigen::Vector3d p;  ///< [m]
  Eigen::Vector3d axis;
};

/** shadow_hand/right_hand.xml of MuJoCo Menagerie; the first joint of each digit in the palm. */
std::vector<std::vector<PublishedJoint>> ListPublishedDigits() {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), none(0, 0, 0);
  const auto finger = [&](double side, double height, double sign) {
    return std::vector<PublishedJoint>{
        {{side, 0, height}, sign * y}, {none, x}, {{0, 0, 0.045}, x}, {{0, 0, 0.025}, x}};
  };
  std::vector<PublishedJoint> little = finger(0.0, 0.06579, 1.0);
  little.insert(little.begin(), {{-0.033, 0, 0.02071}, {0.573576, 0, 0.819152}});
  // The thumb's base is turned by 45 degrees about y.
  return {finger(0.033, 0.095, -1.0),
          finger(0.011, 0.099, -1.0),
          finger(-0.011, 0.095, 1.0),
          little,
          {{{0.034, -0.00858, 0.029}, {0, 0, -1}},
           {none, x},
           {{0, 0, 0.038}, x},
           {none, -y},
           {{0, 0, 0.032}, -y}}};
}

/** Centres of the joints in the palm's frame, all joints at the same angle. */
std::vector<Eigen::Vector3d> CalcPublishedCentres(double angle) {
  std::vector<Eigen::Vector3d> centres;
  const std::vector<std::vector<PublishedJoint>> digits = ListPublishedDigits();
  for (const std::vector<PublishedJoint>& digit : digits) {
    const bool is_thumb = &digit == &digits.back();
    Pose X_PJ = Pose::Identity();
    for (const PublishedJoint& joint : digit) {
      X_PJ = X_PJ * MakePose(joint.p);
      if (is_thumb && &joint == &digit.front())
        X_PJ = X_PJ * MakePose(MakeRotationRpy(0, M_PI / 4, 0), Eigen::Vector3d::Zero());
      centres.push_back(X_PJ.translation());
      X_PJ = X_PJ * Pose(Eigen::AngleAxisd(angle, joint.axis.normalized()));
    }
  }
  return centres;
}

}  // namespace

const std::vector<std::string>& ListDexgraspbenchJoints() {
  static const std::vector<std::string> joints = {
      "FFJ4", "FFJ3", "FFJ2", "FFJ1", "MFJ4", "MFJ3", "MFJ2", "MFJ1", "RFJ4", "RFJ3", "RFJ2",
      "RFJ1", "LFJ5", "LFJ4", "LFJ3", "LFJ2", "LFJ1", "THJ5", "THJ4", "THJ3", "THJ2", "THJ1"};
  return joints;
}

const std::vector<DexgraspnetJoint>& ListDexgraspnetJoints() {
  static const std::vector<DexgraspnetJoint> joints = [] {
    std::vector<DexgraspnetJoint> made;
    for (const std::string& maker : ListDexgraspbenchJoints()) {
      const bool is_reversed =
          maker == "FFJ4" || maker == "MFJ4" || maker == "THJ2" || maker == "THJ1";
      std::string name = "robot0:" + maker;
      --name.back();
      made.push_back({name, maker, is_reversed ? -1.0 : 1.0});
    }
    return made;
  }();
  return joints;
}

double CalcShadowDifference(const Hand& hand, const std::vector<int>& joints) {
  double largest = 0.0;
  for (const double angle : {0.0, 0.3}) {
    const std::vector<Eigen::Vector3d> published = CalcPublishedCentres(angle);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
    for (const int joint : joints) q[joint] = angle;
    for (size_t i = 0; i < joints.size(); ++i) {
      const int link = hand.joints[static_cast<size_t>(joints[i])].link;
      const Eigen::Vector3d centre = CalcLinkPose(hand, q, link).translation();
      largest = std::max(largest, (centre - published[i]).norm());
    }
  }
  return largest;
}

}  // namespace graspbench
