// What must hold for every hand of the project, and the symmetries of single ones.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

class EveryHand : public testing::TestWithParam<std::string> {
 protected:
  Hand hand_ = LoadHand(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Models, EveryHand, testing::ValuesIn(ListHands()), [](const auto& hand) {
  std::string name = hand.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(EveryHand, ListsParentsBeforeChildren) {
  EXPECT_EQ(hand_.links[0].parent, -1);
  for (size_t i = 1; i < hand_.links.size(); ++i) {
    EXPECT_GE(hand_.links[i].parent, 0);
    EXPECT_LT(hand_.links[i].parent, static_cast<int>(i));
  }
  for (int j = 0; j < hand_.num_joints(); ++j) {
    EXPECT_EQ(hand_.links[hand_.joints[j].link].joint, j);
    EXPECT_NEAR(hand_.links[hand_.joints[j].link].axis.norm(), 1.0, 1e-12);
  }
}

TEST_P(EveryHand, HasCompleteDigits) {
  std::set<std::string> ids;
  for (const Digit& digit : hand_.digits) {
    EXPECT_TRUE(ids.insert(digit.id).second);
    ASSERT_FALSE(digit.links.empty());
    EXPECT_EQ(digit.distal_link, digit.links.back());
    // The pad lies on the balls within a millimetre, and the tip is the far end of the last one.
    double pad_gap = 1e9, reach = 0.0;
    for (const ContactSphere& sphere : hand_.contact_spheres) {
      const SurfaceMaterial& surface = hand_.links[sphere.link].surface;
      const bool is_tip = hand_.FindDigitOfLink(sphere.link) >= 0 &&
                          hand_.links[sphere.link].name.find("distal") != std::string::npos;
      if (surface.pad.youngs_modulus > 0.0) {
        EXPECT_TRUE(std::isnan(surface.torsion_radius));  // that of its patch
      } else {
        EXPECT_EQ(surface.torsion_radius > 0.0, is_tip);
      }
      if (sphere.link != digit.distal_link) continue;
      pad_gap = std::min(pad_gap, std::abs((sphere.p_LS - digit.p_LPad).norm() - sphere.radius));
      reach = std::max(reach, sphere.p_LS.z() + sphere.radius);
    }
    EXPECT_LT(pad_gap, 1e-3) << digit.id;
    EXPECT_NEAR(reach, digit.p_LTip.z(), 1e-9) << digit.id;
  }
  EXPECT_EQ(ids.count("TH"), 1u);
}

TEST_P(EveryHand, PalmLooksAtTheFingertipsWhenTheyClose) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, Eigen::VectorXd::Zero(hand_.num_joints()));
  EXPECT_TRUE(X_HL[hand_.palm_link].isApprox(Pose::Identity(), 1e-12));
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand_.num_joints());
  for (int j = 0; j < hand_.num_joints(); ++j) q[j] = 0.5 * hand_.joints[j].upper;
  const std::vector<Pose> closed = CalcLinkPoses(hand_, q);
  for (const Digit& digit : hand_.digits) {
    const Pose X_PL = closed[hand_.palm_link].inverse() * closed[digit.distal_link];
    EXPECT_GT(hand_.palm_normal.dot(X_PL * digit.p_LPad - hand_.p_HCentre), 0.0) << digit.id;
  }
}

TEST_P(EveryHand, IsDrawnWhereItTouches) {
  std::set<int> drawn;
  for (const LinkVisual& visual : hand_.visuals) drawn.insert(visual.link);
  EXPECT_EQ(drawn.size(), hand_.links.size());
  for (const Digit& digit : hand_.digits) {
    for (const Eigen::Vector3d& p : {digit.p_LTip, digit.p_LPad}) {
      double nearest = 1e9;
      for (const LinkVisual& visual : hand_.visuals) {
        if (visual.link != digit.distal_link) continue;
        for (const Eigen::Vector3d& vertex : visual.mesh.vertices) {
          nearest = std::min(nearest, (vertex - p).norm());
        }
      }
      EXPECT_LT(nearest, 4e-3) << digit.id;  // the tip is tapered, vertices lie apart
    }
  }
}

/** Balls of a hand in H at posture q, for comparing sets. */
std::vector<Eigen::Vector3d> PlaceSpheres(const Hand& hand, const Eigen::VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  std::vector<Eigen::Vector3d> points;
  for (const ContactSphere& s : hand.contact_spheres) points.push_back(X_HL[s.link] * s.p_LS);
  return points;
}

double CalcLargestGap(const std::vector<Eigen::Vector3d>& a,
                      const std::vector<Eigen::Vector3d>& b) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : a) {
    double nearest = 1e9;
    for (const Eigen::Vector3d& r : b) nearest = std::min(nearest, (p - r).norm());
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(TumHandTest, IsItsOwnMirrorImageAcrossThePlaneOfTheThumb) {
  const Hand hand = LoadHand("tum");
  const auto posture = [&](double index_q1, double middle_q1, double thumb_q1) {
    Eigen::VectorXd q = Eigen::VectorXd::Constant(hand.num_joints(), 0.3);
    q[hand.FindJoint("FFq1")] = index_q1;
    q[hand.FindJoint("MFq1")] = middle_q1;
    q[hand.FindJoint("THq1")] = thumb_q1;
    return q;
  };
  std::vector<Eigen::Vector3d> mirrored = PlaceSpheres(hand, posture(0.2, 0.05, -0.1));
  for (Eigen::Vector3d& p : mirrored) p.y() = -p.y();
  EXPECT_LT(CalcLargestGap(PlaceSpheres(hand, posture(-0.05, -0.2, 0.1)), mirrored), 1e-9);
}

TEST(TumOriginalHandTest, IsTheSameAfterAThirdOfATurn) {
  const Hand hand = LoadHand("tum-original");
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(hand.num_joints(), 0.25);
  std::vector<Eigen::Vector3d> fingers, turned;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  for (const ContactSphere& s : hand.contact_spheres) {
    if (s.link != hand.palm_link) fingers.push_back(X_HL[s.link] * s.p_LS);
  }
  for (const Eigen::Vector3d& p : fingers) {
    turned.push_back(Eigen::AngleAxisd(2.0 * kPi / 3.0, Eigen::Vector3d::UnitZ()) * p);
  }
  EXPECT_LT(CalcLargestGap(fingers, turned), 1e-7);
}

TEST(ShadowHandTest, ItsFourFingersAreEqual) {
  const Hand hand = LoadHand("shadow");
  for (const char* part : {"proximal", "middle", "distal"}) {
    const HandLink& first = hand.links[hand.FindLink(std::string("ff") + part)];
    for (const char* finger : {"mf", "rf", "lf"}) {
      const HandLink& other = hand.links[hand.FindLink(std::string(finger) + part)];
      EXPECT_EQ(other.mass, first.mass);
      EXPECT_EQ(other.p_LLcm, first.p_LLcm);
      EXPECT_EQ(other.I_LLcm, first.I_LLcm);
    }
  }
}

TEST(ShadowHandTest, HasTheMassesOfTheMaker) {
  const Hand hand = LoadHand("shadow");
  const std::pair<const char*, double> masses_g[] = {
      {"palm", 300},    {"ffknuckle", 8}, {"mfproximal", 30},  {"rfmiddle", 17},
      {"lfdistal", 12}, {"thbase", 10},   {"thproximal", 40},  {"thhub", 5},
      {"thmiddle", 20}, {"thdistal", 16}, {"lfmetacarpal", 30}};
  for (const auto& [link, mass_g] : masses_g) {
    EXPECT_NEAR(GFromKg(hand.links[hand.FindLink(link)].mass), mass_g, 1e-9) << link;
  }
}

}  // namespace
}  // namespace graspbench
