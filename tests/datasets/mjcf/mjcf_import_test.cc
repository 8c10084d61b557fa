// A hand in an exported scene, read again by the importer of foreign hands, is the same hand.

#include <gtest/gtest.h>

#include <random>

#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/import/select_hand.h"
#include "core/hand/import/weld_links.h"
#include "datasets/mjcf/mjcf_export.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

ImportedHand ExportAndImport(const char* hand_id) {
  const TrialSetup setup = MakeBestGraspSetup(hand_id, "toy_cube");
  ConvexPart part;
  part.vertices = {Eigen::Vector3d::Zero()};
  const std::string text = FormatMjcf(setup, RecordMotion(setup).start, {part});
  Diagnostics problems;
  ForeignHand foreign = ReadForeignMjcf(text, "scene.xml", ".", problems);
  const int palm_link = SelectHand("", {}, "scene.xml", problems, foreign);
  HandSource source;
  ShapeLoader loader(source, problems);
  std::vector<LoadedShapes> shapes;
  for (const ForeignLink& link : foreign.links) shapes.push_back(loader.Load(link));
  ImportedHand imported = WeldLinks(foreign, palm_link, shapes, "scene.xml", problems);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  return imported;
}

TEST(MjcfImport, AnExportedHandComesBack) {
  for (const char* hand_id : {"tum-evolved", "shadow-evolved"}) {
    const Hand hand = LoadHand(hand_id);
    const ImportedHand imported = ExportAndImport(hand_id);
    const Hand& other = imported.hand;
    EXPECT_EQ(other.links[static_cast<size_t>(other.palm_link)].name,
              "hand/" + hand.links[static_cast<size_t>(hand.palm_link)].name);
    // All of the hand's own, without the arm's that carry it; but for the distal joints of the rule
    // middle-first, which such a file locks at its start.
    const bool is_locked = hand.coupling == CouplingRule::kMiddleFirst;
    std::vector<int> joint_of;  // by the other's joints
    for (const HandJoint& joint : other.joints) joint_of.push_back(hand.FindJoint(joint.name));
    ASSERT_EQ(static_cast<int>(joint_of.size()), hand.num_joints() - (is_locked ? 4 : 0));
    std::mt19937 random(1);
    Eigen::VectorXd q_hand = Eigen::VectorXd::Zero(hand.num_joints());
    Eigen::VectorXd q_other(other.num_joints());
    for (int j = 0; j < other.num_joints(); ++j) {
      const HandJoint& there = other.joints[static_cast<size_t>(j)];
      ASSERT_GE(joint_of[static_cast<size_t>(j)], 0) << there.name;
      const HandJoint& here = hand.joints[static_cast<size_t>(joint_of[static_cast<size_t>(j)])];
      if (here.coupled_to < 0) {
        EXPECT_NEAR(there.lower, here.lower, 1e-12);  // ties keep the others within theirs
        EXPECT_NEAR(there.upper, here.upper, 1e-12);
      }
      q_other[j] = q_hand[joint_of[static_cast<size_t>(j)]] =
          std::uniform_real_distribution<double>(here.lower, here.upper)(random);
      if (here.coupled_to >= 0) {
        ASSERT_GE(there.coupled_to, 0);
        EXPECT_EQ(other.joints[static_cast<size_t>(there.coupled_to)].name,
                  hand.joints[static_cast<size_t>(here.coupled_to)].name);
        EXPECT_NEAR(there.mimic_ratio, 1.0, 1e-12);
      } else {
        const ForeignDrive& drive = imported.drives[static_cast<size_t>(j)];
        EXPECT_NEAR(drive.stiffness, here.drive.stiffness, 1e-9);
        EXPECT_NEAR(drive.effort, here.drive.torque_limit, 1e-9);
      }
    }
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, q_hand);
    const std::vector<Pose> X_RL = CalcLinkPoses(other, q_other);
    const Pose X_HPalm = X_HL[static_cast<size_t>(hand.palm_link)];
    const Pose X_RPalm = X_RL[static_cast<size_t>(other.palm_link)];
    for (int j = 0; j < other.num_joints(); ++j) {
      const auto here = static_cast<size_t>(
          hand.joints[static_cast<size_t>(joint_of[static_cast<size_t>(j)])].link);
      const auto there = static_cast<size_t>(other.joints[static_cast<size_t>(j)].link);
      const Pose X_PalmHere = X_HPalm.inverse() * X_HL[here];
      const Pose X_PalmThere = X_RPalm.inverse() * X_RL[there];
      EXPECT_LT((X_PalmHere.matrix() - X_PalmThere.matrix()).norm(), 1e-9);
      if (is_locked) continue;  // middle links carry their distal ones
      EXPECT_NEAR(other.links[there].mass, hand.links[here].mass, 1e-9);
      EXPECT_LT((other.links[there].I_LLcm - hand.links[here].I_LLcm).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace graspbench
