#include "core/hand/import/import_hand.h"

#include <gtest/gtest.h>

#include "core/base/text/text.h"
#include "core/hand/import/foreign_hand.h"
#include "tests/core/hand/import/doubts.h"
#include "tests/core/hand/import/import_file.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct Published {
  const char* file;
  const char* digits;
  Eigen::Vector3d normal;
  int num_driven;
  const char* doubts;
};
class PublishedHandTest : public testing::TestWithParam<Published> {};

TEST_P(PublishedHandTest, ImportsUneditedAndLoads) {
  const fs::path file = FindSharedData() / "hands" / GetParam().file;
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  const HandSource source = MakeFileSource(file);
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(ReadFile(file), source, "", problems);
  EXPECT_EQ(FindDoubts(problems), GetParam().doubts);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(imported.num_driven, GetParam().num_driven);
  const Hand hand = WriteAndLoad(imported);
  std::string digits;
  for (const Digit& digit : hand.digits) digits += digit.id + (digit.is_thumb ? "! " : " ");
  EXPECT_EQ(digits, GetParam().digits);
  EXPECT_GT(hand.palm_normal.dot(GetParam().normal), 0.99) << hand.palm_normal.transpose();
  EXPECT_EQ(ImportHand(ReadFile(file), source, "", problems).files, imported.files);
}
INSTANTIATE_TEST_SUITE_P(
    Hands, PublishedHandTest,
    testing::Values(
        Published{"allegro_hand/allegro_hand_right.urdf", "FF MF RF TH! ", {1, 0, 0}, 16, ""},
        Published{"barrett_hand/bhand_model.urdf",
                  "FF MF TH! ",
                  {0, 0, 1},
                  8,
                  "effort of 8 joints (\"finger_1_prox_joint\", \"finger_1_med_joint\", "
                  "\"finger_1_dist_joint\" and 5 more) is 0 or less: a drive without torque moves "
                  "nothing; their drives are guessed\n"}));

class OwnHandTest : public testing::TestWithParam<const char*> {};

// The project's own hands with their meshes, as somebody else's description.
TEST_P(OwnHandTest, IsNotDoubted) {
  const fs::path file = FindDataRoot() / "core/hand/models" / GetParam() / "hand.urdf";
  Diagnostics problems;
  ImportHand(ReadFile(file), MakeFileSource(file), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(FindDoubts(problems), "");
}
INSTANTIATE_TEST_SUITE_P(Models, OwnHandTest, testing::Values("tum", "tum-original", "shadow"));

double CalcMass(const Hand& hand) {
  double mass = 0.0;
  for (const HandLink& link : hand.links) mass += link.mass;
  return mass;
}

class StrangersHandTest : public testing::Test {
 protected:
  bool Import(const char* name, const std::string& palm = "", bool covers = false) {
    const fs::path file = FindSharedData() / "strangers" / "hands" / name;
    if (!fs::exists(file)) return false;
    Diagnostics problems;
    imported_ = ImportHand(ReadFile(file), MakeFileSource(file, covers), palm, problems);
    told_ = problems.Format();
    hand_ = WriteAndLoad(imported_);
    return true;
  }
  ImportedFiles imported_;
  std::string told_;
  Hand hand_;
};

// 1.5 and twice 0.09 kg; jaws of 140 mm, whatever the 15.5 mm between the slides.
TEST_F(StrangersHandTest, LongJawsStayAsDrawn) {
  if (!Import("long_jaws.urdf")) GTEST_SKIP() << "not on this machine";
  EXPECT_EQ(told_.find("taken to be in"), told_.npos) << told_;
  EXPECT_NEAR(CalcMass(hand_), 1.68, 1e-9);
}

// A palm of 0.35 kg, eight links of 0.03 kg, and a frame of 1 mg whose axes are only drawn.
TEST_F(StrangersHandTest, DrawnAxesNeitherTouchNorWeigh) {
  if (!Import("axes.urdf", "", true)) GTEST_SKIP() << "not on this machine";
  EXPECT_NE(told_.find("link \"base\" has a picture and no collision shape"), told_.npos) << told_;
  EXPECT_NEAR(CalcMass(hand_), 0.59 + 1e-6, 1e-9);
  for (const ContactSphere& ball : hand_.contact_spheres) {
    if (ball.link != hand_.palm_link) continue;
    EXPECT_LT((ball.p_LS.cwiseAbs().array() + ball.radius).maxCoeff(),
              0.046);  // of the palm's box and 1 mm
  }
}

// Half a tube of R 42 mm, a wall of 2 mm. Its open side is as the description has it.
TEST_F(StrangersHandTest, BallsStayInTheWallOfHalfATube) {
  if (!Import("cover_palm.urdf", "", true)) GTEST_SKIP() << "not on this machine";
  ASSERT_EQ(imported_.fits[0].link, "palm");
  for (const ContactFit& fit : imported_.fits) {
    EXPECT_LE(fit.out.most, 0.001) << fit.link;
    EXPECT_LE(fit.sink.at_95, 0.001) << fit.link;
    EXPECT_LE(fit.sink.most, 0.005) << fit.link;
    EXPECT_LE(fit.num_balls, 600) << fit.link;
  }
  for (const ContactSphere& ball : hand_.contact_spheres) {
    EXPECT_LT(ball.radius, ball.link == hand_.palm_link ? 0.002 : 0.02);
  }
  EXPECT_EQ(told_.find("enter the palm"), told_.npos) << told_;
}

// The leg above the palm has a mesh that is nowhere; a palm of 0.35 and eight links of 0.03 kg.
TEST_F(StrangersHandTest, WhatANamedPalmLeavesOutNeedNotExist) {
  if (!Import("missing_above.urdf", "palm")) GTEST_SKIP() << "not on this machine";
  EXPECT_NEAR(CalcMass(hand_), 0.59, 1e-9);
  EXPECT_EQ(hand_.num_joints(), 8);
}

// A palm of 0.35 kg, eight bodies of 0.03 kg that MuJoCo raises to 0.05 kg and 1e-5 kg m^2.
TEST_F(StrangersHandTest, BoundsOfMassAndInertiaAreApplied) {
  if (!Import("boundmass.xml")) GTEST_SKIP() << "not on this machine";
  EXPECT_NEAR(CalcMass(hand_), 0.75, 1e-9);
  const Eigen::Matrix3d I = hand_.links[static_cast<size_t>(hand_.FindLink("ff2"))].I_LLcm;
  EXPECT_LT((I - 1e-5 * Eigen::Matrix3d::Identity()).norm(), 1e-12) << I;
}

// Bars of 16 x 14 x 42 mm by their eight corners.
TEST_F(StrangersHandTest, AMeshOfVerticesIsTheirHull) {
  if (!Import("vertex_mesh.xml")) GTEST_SKIP() << "not on this machine";
  EXPECT_NEAR(CalcMass(hand_), 0.59, 1e-9);
  Eigen::AlignedBox3d box;
  for (const LinkVisual& visual : hand_.visuals) {
    if (visual.link == hand_.FindLink("ff2")) box.extend(CalcBounds(visual.mesh));
  }
  EXPECT_LT((box.sizes() - Eigen::Vector3d(0.016, 0.014, 0.042)).norm(), 1e-6);
}

std::string ErrorOf(const std::string& urdf) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(urdf, MakeSourceWithoutMeshes(), "", problems);
  EXPECT_TRUE(imported.files.empty());
  for (const Diagnostic& problem : problems.entries()) {
    if (problem.severity == Severity::kError) return problem.text;
  }
  return "";
}

/** The gripper with its lengths in another unit, and its inertias in that unit squared. */
std::string InUnit(double unit) {
  std::string text = kSmallGripper;
  for (const auto& [start, scale] : {std::pair{"xyz=\"0", unit},
                                     {"size=\"", unit},
                                     {"ixx=\"", unit * unit},
                                     {"iyy=\"", unit * unit},
                                     {"izz=\"", unit * unit}}) {
    for (size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) {
      if (text.compare(at - 5, 5, "axis ") == 0) continue;
      const size_t from = text.find('"', at) + 1, to = text.find('"', from);
      const auto numbers = ParseNumbers(text.substr(from, to - from).c_str());
      std::string scaled;
      for (const double number : numbers.value()) {
        scaled += (scaled.empty() ? "" : " ") + FormatSignificant(number / scale, 12);
      }
      text.replace(from, to - from, scaled);
    }
  }
  for (int k = 0; k < 2; ++k) {
    text = ReplaceOnce(text, "upper=\"0.04\"",
                       "upper=\"" + FormatSignificant(0.04 / unit, 12) + "\" ");
  }
  return text;
}

TEST(ImportHandTest, AnotherUnitIsInferredOrSaidAndGivesTheSameHand) {
  Diagnostics problems;
  const std::string urdf =
      ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems).files.at("hand.urdf");
  for (const double unit : {0.01, 0.001}) {
    for (const bool is_said : {false, true}) {
      HandSource source = MakeSourceWithoutMeshes();
      if (is_said) source.unit = unit;
      Diagnostics told;
      const ImportedFiles imported = ImportHand(InUnit(unit), source, "", told);
      ASSERT_EQ(told.num_errors(), 0) << told.Format();
      EXPECT_EQ(imported.files.at("hand.urdf"), urdf);
      EXPECT_EQ(told.Format().find("is taken to be in") == std::string::npos, is_said);
    }
  }
}

/** The gripper on an arm whose joints and second link are as `joint` and `link` have it. */
std::string PutOnArm(const std::string& joint, const std::string& link) {
  const std::string solid = "<collision><geometry><sphere radius=\"0.05\"/></geometry></collision>";
  return ReplaceOnce(
      kSmallGripper, "<link name=\"world\"/>",
      "<link name=\"floor\"/><link name=\"upper_arm\">" + solid + "</link><link name=\"world\">" +
          link +
          "</link><joint name=\"shoulder\" type=\"continuous\"><parent link=\"floor\"/>"
          "<child link=\"upper_arm\"/>" +
          joint +
          "</joint>"
          "<joint name=\"elbow\" type=\"revolute\"><parent link=\"upper_arm\"/>"
          "<child link=\"world\"/><limit lower=\"-2\" upper=\"2\" effort=\"330\" velocity=\"1\"/>" +
          joint + "</joint>");
}

std::string ImportWithPalm(const std::string& text, int& num_errors) {
  Diagnostics problems;
  ImportHand(text, MakeSourceWithoutMeshes(), "the hand", problems);
  num_errors = problems.num_errors();
  return problems.Format();
}

// A rotation by "quat_xyzw" and a joint of unknown type are refused where they are the hand's own.
TEST(ImportHandTest, WhatANamedPalmLeavesOutNeedNotBeUnderstood) {
  const std::string odd = "<origin xyz=\"0 0 0.3\" quat_xyzw=\"0 0 0 1\"/>";
  const std::string solid =
      "<collision>" + odd + "<geometry><box size=\"0.1 0.1 0.1\"/></geometry></collision>";
  int num_errors = 0;
  const std::string told = ImportWithPalm(PutOnArm(odd, solid), num_errors);
  EXPECT_EQ(num_errors, 0) << told;
  for (const char* of_arm : {"quat_xyzw", "continuous", "more than a finger bears"}) {
    EXPECT_EQ(told.find(of_arm), told.npos) << told;
  }
  std::string own = PutOnArm("", "");
  own = ReplaceOnce(own, "<origin xyz=\"0 0 0.06\"/><axis xyz=\"0 1 0\"/>",
                    "<origin xyz=\"0 0 0.06\" quat_xyzw=\"0 0 0 1\"/><axis xyz=\"0 1 0\"/>");
  EXPECT_NE(ImportWithPalm(own, num_errors)
                .find("joint \"slide_left\": its <origin> has the attribute \"quat_xyzw\""),
            std::string::npos);
  EXPECT_EQ(num_errors, 1);
  const std::string away =
      ReplaceOnce(PutOnArm(odd, ""), "<child link=\"upper_arm\"/>", "<child link=\"nobody\"/>");
  ImportWithPalm(away, num_errors);
  EXPECT_GT(num_errors, 0) << "without a tree nothing can be selected";
}

TEST(ImportHandTest, AHandOfNoSizeIsRefused) {
  EXPECT_EQ(ErrorOf(InUnit(1000.0)),
            "the hand is 0.0002 m across; a hand is 15 mm to 2 m with its forearm. Descriptions "
            "are in metres: if the unit is another, say it with --unit");
}

TEST(ImportHandTest, AMissingCollisionMeshIsRefusedByName) {
  const std::string told = ErrorOf(ReplaceOnce(kSmallGripper, "<box size=\"0.06 0.2 0.06\"/>",
                                               "<mesh filename=\"package://g/palm.stl\"/>"));
  EXPECT_EQ(told.substr(0, 76),
            "link \"the hand\", collision: mesh not found: \"package://g/palm.stl\"; give the")
      << told;
}

TEST(ImportHandTest, AMissingPictureThatTheLinkTouchesWithIsRefused) {
  std::string pictured = ReplaceOnce(kSmallGripper, "<collision>", "<visual>");
  pictured = ReplaceOnce(pictured, "</collision>", "</visual>");
  pictured = ReplaceOnce(pictured, "<box size=\"0.06 0.2 0.06\"/>", "<mesh filename=\"p.stl\"/>");
  EXPECT_EQ(ErrorOf(pictured).substr(0, 51),
            "link \"the hand\", visual: mesh not found: \"p.stl\"; g");
}

TEST(ImportHandTest, OtherFilesAreNamed) {
  EXPECT_EQ(ErrorOf(std::string("\xff\xfe<\0r\0", 6)),
            "the text is UTF-16; expected UTF-8, so save it as that");
  EXPECT_EQ(ErrorOf("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n"),
            "a Git LFS pointer, not the file itself; get it with: git lfs pull");
  EXPECT_EQ(ErrorOf("<robot type=\"Hand\"><palm>palm.xml</palm><chain/></robot>"),
            "a robot of GraspIt (<palm>, <chain>), not a URDF; give a URDF or MJCF of the hand");
}

// 0.7 kg of the palm lumped into a bone of 8 mm that is fixed to it: 130 g/cm^3 of its own bounds,
// 1 g/cm^3 of both.
TEST(ImportHandTest, AMassIsJudgedByAllPartsThatAreFixedTogether) {
  std::string urdf = ReplaceOnce(kSmallGripper, "<link name=\"world\"/>",
                                 R"(<link name="world"><inertial><mass value="0.7"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0017"/></inertial>
    <collision><geometry><box size="0.008 0.008 0.008"/></geometry></collision></link>)");
  urdf = ReplaceOnce(urdf, "<origin xyz=\"0 0 1\"", "<origin xyz=\"0 0 0.05\"");
  const size_t begin = urdf.find("<inertial>", urdf.find("<link name=\"the hand\">"));
  urdf.erase(begin, urdf.find("</inertial>", begin) + 11 - begin);
  Diagnostics problems, of_loading;
  const ImportedFiles imported = ImportHand(urdf, MakeSourceWithoutMeshes(), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  const Hand hand =
      ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), ".", of_loading);
  EXPECT_NEAR(hand.links[0].mass, 0.7, 1e-12);
  EXPECT_EQ(problems.Format().find("denser"), std::string::npos) << problems.Format();
}

TEST(ImportHandTest, TheGripperImports) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems);
  EXPECT_EQ(problems.Format(),
            "gripper.urdf:26: warning: link \"right\": no <inertial>; replaced: mass of its volume "
            "at 1200 kg/m^3, inertia of its volume, 19.8 g");
  EXPECT_EQ(imported.num_digits, 2);
  EXPECT_EQ(imported.num_driven, 1);
  EXPECT_EQ(imported.files.size(), 4u);  // hand.urdf, hand.yaml, README.md, import.json
}

}  // namespace
}  // namespace graspbench
