// Every named link of a description keeps its frame: forward kinematics of the imported hand against
// those of the file, computed here from its numbers alone.
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <random>
#include <sstream>

#include "core/hand/hand.h"
#include "tests/core/hand/import/import_file.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

Vector3d ReadThree(const tinyxml2::XMLElement* element, const char* name, const Vector3d& missing) {
  const char* text = element ? element->Attribute(name) : nullptr;
  if (!text) return missing;
  std::istringstream stream(text);
  Vector3d v = missing;
  stream >> v.x() >> v.y() >> v.z();
  return v;
}

/** Poses of all links of a URDF in its root. @param q  by joint. */
std::map<std::string, Eigen::Isometry3d> CalcFrames(const tinyxml2::XMLElement& robot,
                                                    const std::map<std::string, double>& q) {
  std::map<std::string, const tinyxml2::XMLElement*> joint_of;
  for (auto* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
    joint_of[e->FirstChildElement("child")->Attribute("link")] = e;
  }
  std::map<std::string, Eigen::Isometry3d> frames;
  const std::function<Eigen::Isometry3d(const std::string&)> calc = [&](const std::string& link) {
    const auto found = joint_of.find(link);
    if (found == joint_of.end()) return Eigen::Isometry3d(Eigen::Isometry3d::Identity());
    const auto* joint = found->second;
    Eigen::Isometry3d X = calc(joint->FirstChildElement("parent")->Attribute("link"));
    const Vector3d xyz = ReadThree(joint->FirstChildElement("origin"), "xyz", Vector3d::Zero());
    const Vector3d rpy = ReadThree(joint->FirstChildElement("origin"), "rpy", Vector3d::Zero());
    X = X * Eigen::Translation3d(xyz) * AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
        AngleAxisd(rpy.y(), Vector3d::UnitY()) * AngleAxisd(rpy.x(), Vector3d::UnitX());
    const std::string type = joint->Attribute("type");
    const auto position = q.find(joint->Attribute("name"));
    if (type == "fixed" || position == q.end()) return X;
    const Vector3d axis =
        ReadThree(joint->FirstChildElement("axis"), "xyz", Vector3d::UnitX()).normalized();
    if (type == "prismatic")
      return Eigen::Isometry3d(X * Eigen::Translation3d(position->second * axis));
    return Eigen::Isometry3d(X * AngleAxisd(position->second, axis));
  };
  for (auto* e = robot.FirstChildElement("link"); e; e = e->NextSiblingElement("link")) {
    frames[e->Attribute("name")] = calc(e->Attribute("name"));
  }
  return frames;
}

class NamedFramesTest : public testing::TestWithParam<const char*> {};

TEST_P(NamedFramesTest, AreWhereTheDescriptionHasThem) {
  const fs::path file = FindDescription(GetParam());
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(ReadFile(file), MakeFileSource(file), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  const Hand hand = WriteAndLoad(imported);

  tinyxml2::XMLDocument document;
  const std::string text = ReadFile(file);
  ASSERT_EQ(document.Parse(text.data(), text.size()), tinyxml2::XML_SUCCESS);
  std::mt19937 random(7);
  double largest = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd q(hand.num_joints());
    for (int j = 0; j < hand.num_joints(); ++j) {
      const HandJoint& joint = hand.joints[j];
      q[j] = std::uniform_real_distribution<double>(joint.lower, joint.upper)(random);
    }
    ApplyCoupling(hand, q);
    std::map<std::string, double> by_name;
    for (int j = 0; j < hand.num_joints(); ++j) by_name[hand.joints[j].name] = q[j];
    const auto expected = CalcFrames(*document.RootElement(), by_name);
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
    std::map<std::string, Eigen::Isometry3d> found;
    for (size_t i = 0; i < hand.links.size(); ++i) {
      found[hand.links[i].name] = Eigen::Isometry3d(X_HL[i].matrix());
    }
    for (const NamedFrame& frame : hand.frames) {
      found[frame.name] = Eigen::Isometry3d((X_HL[frame.link] * frame.X_LF).matrix());
    }
    ASSERT_EQ(found.size(), expected.size());
    const std::string palm = hand.links[hand.palm_link].name;
    for (const auto& [link, X] : expected) {
      ASSERT_EQ(found.count(link), 1u) << link;
      const Eigen::Matrix4d apart = (found[palm].inverse() * found[link]).matrix() -
                                    (expected.at(palm).inverse() * X).matrix();
      largest = std::max(largest, apart.cwiseAbs().maxCoeff());
      EXPECT_LT(apart.cwiseAbs().maxCoeff(), 1e-9) << link;  // 1e-6 mm
    }
  }
  RecordProperty("largest_difference_pm", std::to_string(1e12 * largest));
}

// Bodies at (10, 30, 8) mm and 45 mm above; the joint between them lies 5 mm beside the second.
TEST(NamedFrames, ABodyBesideItsJointKeepsItsFrame) {
  const fs::path file = FindDescription("joint_beside_body.xml");
  Diagnostics problems;
  const Hand hand = WriteAndLoad(ImportHand(ReadFile(file), MakeFileSource(file), "", problems));
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  const Pose X_PH = X_HL[hand.palm_link].inverse();
  int num_found = 0;
  for (const NamedFrame& frame : hand.frames) {
    if (frame.name != "index_medial") continue;
    ++num_found;
    const Vector3d p = (X_PH * X_HL[frame.link] * frame.X_LF).translation();
    EXPECT_LT((p - Vector3d(0.010, 0.030, 0.053)).norm(), 1e-9) << p.transpose();
  }
  EXPECT_EQ(num_found, 1);
}

INSTANTIATE_TEST_SUITE_P(Hands, NamedFramesTest,
                         testing::Values("claw_tips.urdf", "five_digits_mount.urdf",
                                         "five_digits_offset.urdf", "pincer.urdf",
                                         "claw_spread.urdf", "allegro_hand/allegro_hand_right.urdf",
                                         "barrett_hand/bhand_model.urdf"));

}  // namespace
}  // namespace graspbench
