#include "core/hand/import/write_hand.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/hand/coupling.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

TEST(WriteHandTest, WhatIsWrittenIsTheHand) {
  Diagnostics problems;
  std::string urdf = ReplaceOnce(kSmallGripper, "name=\"left\"", "name=\"l: #&quot;&lt;\"");
  urdf = ReplaceOnce(urdf, "child link=\"left\"", "child link=\"l: #&quot;&lt;\"");
  urdf = ReplaceOnce(urdf, "xyz=\"0 0 0.06\"", "xyz=\"0.001 0.002 0.06\" rpy=\"0.1 -0.2 0.3\"");
  urdf = ReplaceOnce(urdf, "<mimic joint=\"slide_left\"/>",
                     "<mimic joint=\"slide_left\" multiplier=\"0.5\" offset=\"0.002\"/>");
  const ForeignHand foreign = ReadForeignUrdf(urdf, "g.urdf", problems);
  const HandSource source = MakeSourceWithoutMeshes();
  ShapeLoader loader(source, problems);
  std::vector<LoadedShapes> shapes;
  for (const ForeignLink& link : foreign.links) shapes.push_back(loader.Load(link));
  ImportedHand imported = WeldLinks(foreign, shapes, "", "g.urdf", problems);
  imported.hand.name = foreign.name;
  GuessHand("g.urdf", {}, imported, problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  const auto files = FormatHandFiles(imported, "g.urdf", problems);
  Diagnostics of_loading;
  const Hand hand = ParseHand(files.at("hand.urdf"), files.at("hand.yaml"), "x", of_loading);
  ASSERT_EQ(of_loading.Format(), "");

  EXPECT_EQ(hand.name, "parallel gripper ü");
  EXPECT_GE(hand.FindLink("l: #\"<"), 0);
  RandomStream random("write_hand_test", "q");
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd before(2), after(2);
    before[0] = random.NextUniform(0.0, 0.04);
    ApplyCoupling(imported.hand, before);
    EXPECT_NEAR(before[1], 0.002 + 0.5 * before[0], 1e-12);
    for (int j = 0; j < 2; ++j) {
      after[hand.FindJoint(imported.hand.joints[j].name)] = before[j];
    }
    for (const HandLink& link : hand.links) {
      const Pose X = CalcLinkPose(hand, after, hand.FindLink(link.name));
      const Pose Y = CalcLinkPose(imported.hand, before, imported.hand.FindLink(link.name));
      EXPECT_LT((X.matrix() - Y.matrix()).norm(), 1e-8) << link.name;
    }
  }
  for (const HandLink& link : hand.links) {
    const HandLink& other = imported.hand.links[imported.hand.FindLink(link.name)];
    EXPECT_NEAR(link.mass, other.mass, 1e-9);
    EXPECT_LT((link.I_LLcm - other.I_LLcm).norm(), 1e-9 * other.I_LLcm.norm() + 1e-15);
  }
}

TEST(WriteHandTest, MarksWhatIsAGuessAndTellsWhatWasRepaired) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems);
  const std::string& yaml = imported.files.at("hand.yaml");
  size_t num_guesses = 0;
  for (size_t at = yaml.find("guess"); at != std::string::npos; at = yaml.find("guess", at + 1)) {
    ++num_guesses;
  }
  EXPECT_GE(num_guesses, 10u);
  EXPECT_NE(imported.files.at("README.md").find("line 26: link \"right\": no <inertial>"),
            std::string::npos)
      << imported.files.at("README.md");
}

}  // namespace
}  // namespace graspbench
