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
  bool Import(const char* name) {
    const fs::path file = FindSharedData() / "strangers" / "hands" / name;
    if (!fs::exists(file)) return false;
    Diagnostics problems;
    imported_ = ImportHand(ReadFile(file), MakeFileSource(file), "", problems);
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
  if (!Import("axes.urdf")) GTEST_SKIP() << "not on this machine";
  EXPECT_NE(told_.find("link \"base\" has a picture and no collision shape"), told_.npos) << told_;
  EXPECT_NEAR(CalcMass(hand_), 0.59 + 1e-6, 1e-9);
  for (const ContactSphere& ball : hand_.contact_spheres) {
    if (ball.link != hand_.palm_link) continue;
    EXPECT_LT((ball.p_LS.cwiseAbs().array() + ball.radius).maxCoeff(),
              0.0451);  // of the palm's box
  }
}

// One capsule of the tube's radius of 42 mm about its axis, which lies in the open side.
TEST_F(StrangersHandTest, ACapsuleInHalfATubeSticksOutByItsRadius) {
  if (!Import("cover_palm.urdf")) GTEST_SKIP() << "not on this machine";
  ASSERT_EQ(imported_.protrusions[0].link, "palm");
  EXPECT_NEAR(imported_.protrusions[0].protrusion, 0.042, 0.0005);
  EXPECT_NE(told_.find("link \"palm\": its contact shapes stick out of its convex hull by up to 4"),
            told_.npos)
      << told_;
  EXPECT_EQ(imported_.files.at("README.md").find("95 % within"), std::string::npos);
  // Balls within boxes.
  for (size_t k = 1; k < imported_.protrusions.size(); ++k) {
    EXPECT_LT(imported_.protrusions[k].protrusion, 1e-6) << imported_.protrusions[k].link;
  }
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
