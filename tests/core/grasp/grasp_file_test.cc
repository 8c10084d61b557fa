#include "core/grasp/grasp_file.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

const Vector3d kSize(0.0617, 0.0534, 0.026);

const Hand& TumHand() {
  static const Hand hand = LoadHand("tum");
  return hand;
}

/** The power grasp as an optimisation leaves it. */
Grasp MakeOptimisedGrasp(const Hand& hand) {
  Grasp grasp = LoadStandardGrasps(hand).at(2);
  grasp.id = "new-target";
  grasp.object = "adhesive_tape";
  grasp.placement = CalcPlacement(hand, grasp, kSize, Vector3d::Zero());
  grasp.q_target[hand.FindJoint("THq2")] += RadFromDeg(3.7654321);
  return grasp;
}

TEST(GraspFile, GivesBackWhatWasWritten) {
  for (const char* id : {"tum", "shadow"}) {
    const Hand hand = LoadHand(id);
    Grasp grasp = LoadStandardGrasps(hand).at(2);
    grasp.id = "new-target";
    grasp.object = "can";
    // A can is grasped from the side: another approach, another orientation.
    grasp.placement = CalcPlacement(hand, grasp, {0.066, 0.066, 0.116}, Vector3d::Zero());
    const std::string text = FormatGraspFile(hand, grasp, "g3");
    const GraspFile file = ParseGraspFile(text, "x.yaml", {&hand});
    EXPECT_EQ(file.hand, id);
    EXPECT_EQ(file.grasp.id, grasp.id);
    EXPECT_EQ(file.grasp.type, grasp.type);
    EXPECT_EQ(file.grasp.approach_distance, grasp.approach_distance);
    EXPECT_EQ(file.grasp.palm_gap, grasp.palm_gap);
    EXPECT_EQ(file.grasp.approach, grasp.approach);
    EXPECT_EQ(file.grasp.alpha, grasp.alpha);
    EXPECT_NEAR(file.grasp.tilt, grasp.tilt, 1e-7);
    EXPECT_EQ(file.grasp.digits, grasp.digits);
    EXPECT_EQ(file.grasp.palm_may_touch, grasp.palm_may_touch);
    EXPECT_EQ(file.grasp.object, "can");
    EXPECT_TRUE(file.grasp.q_pre.isApprox(grasp.q_pre, 1e-7));
    EXPECT_TRUE(file.grasp.q_target.isApprox(grasp.q_target, 1e-7));
    ASSERT_TRUE(file.grasp.placement);
    EXPECT_TRUE(file.grasp.placement->X_WH.isApprox(grasp.placement->X_WH, 1e-8));
    EXPECT_TRUE(file.grasp.placement->approach_W.isApprox(grasp.placement->approach_W, 1e-8));
    EXPECT_NEAR(file.grasp.placement->closing_at_contact, grasp.placement->closing_at_contact,
                1e-8);
    EXPECT_EQ(FormatGraspFile(hand, file.grasp, "g3"), text);
  }
}

Grasp MakePlayedGrasp(const Hand& hand) {
  Grasp grasp = MakeOptimisedGrasp(hand);
  grasp.seeks_palm = false;
  grasp.course.period = 0.02;
  grasp.course.closure_start = 0.0125;
  grasp.course.p_HAway = {{0.001, -0.002, -0.03}, {0.0, 0.0, -0.01}, {0.0, 0.0, 0.0}};
  for (const std::string& digit : grasp.digits) grasp.course.closing[digit] = {0.0, 0.125, 0.375};
  return grasp;
}

TEST(GraspFile, GivesBackTheCourse) {
  const Hand& hand = TumHand();
  const Grasp grasp = MakePlayedGrasp(hand);
  const std::string text = FormatGraspFile(hand, grasp, "g3");
  const GraspCourse course = ParseGraspFile(text, "x.yaml", {&hand}).grasp.course;
  EXPECT_EQ(course.period, grasp.course.period);
  EXPECT_EQ(course.closure_start, grasp.course.closure_start);
  EXPECT_EQ(course.p_HAway, grasp.course.p_HAway);
  EXPECT_EQ(course.closing, grasp.course.closing);
}

TEST(GraspFile, RefusesACourseThatNoHandFollows) {
  const Hand& hand = TumHand();
  const auto find = [&](const auto& change) -> std::string {
    Grasp grasp = MakePlayedGrasp(hand);
    change(grasp);
    try {
      ParseGraspFile(FormatGraspFile(hand, grasp, "g3"), "x.yaml", {&hand});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto expect = [&](const char* part, const auto& change) {
    const std::string text = find(change);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_EQ(find([](Grasp&) {}), "");
  expect("ends 10.000 mm from its grasp position",
         [](Grasp& g) { g.course.p_HAway.back().z() = 0.01; });
  expect("two or more; found 1, 1 and 1", [](Grasp& g) { g.course.p_HAway.resize(1); });
  expect("expected 3 values, one for each of x_m, found 2",
         [](Grasp& g) { g.course.closing.begin()->second.pop_back(); });
  expect("expected values from 0 to 1, found 1.500",
         [](Grasp& g) { g.course.closing.begin()->second[1] = 1.5; });
  expect("after the end of the course at 0.040 s", [](Grasp& g) { g.course.closure_start = 0.05; });
  expect("course.closing", [](Grasp& g) { g.course.closing.erase(g.digits.front()); });
  expect("remove course or seeks_palm", [](Grasp& g) {
    g.palm_may_touch = true;
    g.seeks_palm = true;
  });
}

TEST(GraspFile, NamesOfPeopleAreReadAsTheyAre) {
  Hand hand = TumHand();
  hand.id = "=my: hand #2";
  Grasp grasp = MakeOptimisedGrasp(hand);
  grasp.id = "{new}";
  grasp.object = "cup: \"blue\"\nid: g1";
  const GraspFile file = ParseGraspFile(FormatGraspFile(hand, grasp, "g3"), "x.yaml", {&hand});
  EXPECT_EQ(file.hand, hand.id);
  EXPECT_EQ(file.grasp.id, grasp.id);
  EXPECT_EQ(file.grasp.object, grasp.object);
  const YAML::Node node =
      YAML::Load(FormatIsaacGrasp(hand, grasp, grasp.object, kSize, Vector3d::Zero(), 1.0));
  EXPECT_EQ(node["object_frame"].as<std::string>(), grasp.object);
  EXPECT_TRUE(node["grasps"][grasp.id].IsMap());
}

TEST(GraspFile, TellsEveryProblemWithItsLine) {
  const std::string text =
      "format: graspbench grasp\n"
      "format_version: 2\n"
      "id: g3\n"
      "hand: tum\n"
      "made_from: g8\n"
      "digits: [TH, XX]\n"
      "tilt_deg: 0\n"
      "pre_deg: {FF: [0, 0], MF: [0, 0, 0], TH: [0, 0, 0]}\n"
      "target_deg: {FF: [0, 0, 0], MF: [0, 0, 0], TH: [0, 95, 0]}\n"
      "placement: {position_m: [0, 0, 0], orientation_wxyz: [2, 0, 0, 0], approach: [0, 0, -1],\n"
      "            closing_at_contact: 1.5}\n"
      "grip: 3\n";
  try {
    ParseGraspFile(text, "my.yaml", {&TumHand()});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    const std::string message = e.what();
    for (const char* expected :
         {"my.yaml:2: error: grasp, format_version: this program reads version 1, found 2",
          "my.yaml:3: error: grasp, id: \"g3\" is the name of a standard grasp; choose another",
          "my.yaml:5: error: grasp, made_from: no standard grasp \"g8\"",
          "my.yaml:6: error: grasp, digits: the hand has no digit \"XX\"",
          "my.yaml:8: error: pre_deg, FF: expected 3 angles",
          "my.yaml:9: error: target_deg, TH: joint THq2 at 95.000000 deg is outside its limits",
          "my.yaml:10: error: placement, orientation_wxyz: expected a quaternion of length one, "
          "found length 2.000",
          "placement, closing_at_contact: 1.5 is out of range; expected 0 to 1",
          "my.yaml:12: error: grasp: unknown key \"grip\""}) {
      EXPECT_NE(message.find(expected), std::string::npos) << expected << "\n in\n" << message;
    }
  }
}

TEST(GraspFile, SaysForWhichHandItIs) {
  const Hand shadow = LoadHand("shadow");
  try {
    ParseGraspFile(FormatGraspFile(TumHand(), MakeOptimisedGrasp(TumHand()), "g3"), "my.yaml",
                   {&shadow});
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "the grasp cannot be used\nmy.yaml:4: error: grasp, hand: the grasp is for the "
                 "hand \"tum\", which is not in use here; in use: shadow");
  }
}

// The format's own rules, read by another reader: version 1.0, the hand's pose in the object's
// frame, joint values by name.
TEST(IsaacGrasp, HoldsTheHandInTheObjectsFrame) {
  const Hand& hand = TumHand();
  const Grasp grasp = MakeOptimisedGrasp(hand);
  const YAML::Node root =
      YAML::Load(FormatIsaacGrasp(hand, grasp, "adhesive_tape", kSize, Vector3d::Zero(), 0.9));
  EXPECT_EQ(root["format"].as<std::string>(), "isaac_grasp");
  EXPECT_EQ(root["format_version"].as<std::string>(), "1.0");
  EXPECT_EQ(root["object_frame"].as<std::string>(), "adhesive_tape");
  const YAML::Node entry = root["grasps"]["new-target"];
  EXPECT_EQ(entry["confidence"].as<double>(), 0.9);
  const auto position = entry["position"].as<std::vector<double>>();
  const Pose& X_WH = grasp.placement->X_WH;
  EXPECT_NEAR(position[0], X_WH.translation().x(), 1e-9);
  EXPECT_NEAR(position[2], X_WH.translation().z() - 0.013, 1e-9);  // O is half the height up
  const auto xyz = entry["orientation"]["xyz"].as<std::vector<double>>();
  const Eigen::Quaterniond q(entry["orientation"]["w"].as<double>(), xyz[0], xyz[1], xyz[2]);
  EXPECT_TRUE(q.toRotationMatrix().isApprox(X_WH.linear(), 1e-8));
  EXPECT_EQ(entry["cspace_position"].size(), hand.joints.size());
  for (size_t joint = 0; joint < hand.joints.size(); ++joint) {
    const std::string& name = hand.joints[joint].name;
    const auto index = static_cast<Eigen::Index>(joint);
    EXPECT_NEAR(entry["cspace_position"][name].as<double>(), grasp.q_target[index], 1e-9);
    EXPECT_NEAR(entry["pregrasp_cspace_position"][name].as<double>(), grasp.q_pre[index], 1e-9);
  }
}

}  // namespace
}  // namespace graspbench
