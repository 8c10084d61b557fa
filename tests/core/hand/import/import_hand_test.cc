#include "core/hand/import/import_hand.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "tests/core/hand/import/small_gripper.h"
#include "tests/support/shared_data.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct Published {
  const char* file;
  const char* digits;
  Eigen::Vector3d normal;
  int num_driven;
};
class PublishedHandTest : public testing::TestWithParam<Published> {};

TEST_P(PublishedHandTest, ImportsUneditedAndLoads) {
  const fs::path file = FindSharedData() / "hands" / GetParam().file;
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  HandSource source;
  source.file = file.string();
  source.folder = file.parent_path();
  source.load_mesh = [](const fs::path& path) {
    Diagnostics problems;
    const TriMesh mesh = ParseObj(ReadFile(path), path.string(), problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "broken");
    return mesh;
  };
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(ReadFile(file), source, "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(imported.num_driven, GetParam().num_driven);
  const fs::path out =
      fs::path(testing::TempDir()) / ("published_hand_" + std::to_string(::getpid()));
  fs::remove_all(out);
  for (const auto& [name, content] : imported.files) {
    MakeFolder((out / name).parent_path());
    WriteFile(out / name, content);
  }
  Diagnostics of_loading;
  const Hand hand = CheckHand(out.string(), of_loading);
  EXPECT_EQ(of_loading.Format(), "");
  std::string digits;
  for (const Digit& digit : hand.digits) digits += digit.id + (digit.is_thumb ? "! " : " ");
  EXPECT_EQ(digits, GetParam().digits);
  EXPECT_GT(hand.palm_normal.dot(GetParam().normal), 0.99) << hand.palm_normal.transpose();
  EXPECT_EQ(ImportHand(ReadFile(file), source, "", problems).files, imported.files);
  fs::remove_all(out);
}
INSTANTIATE_TEST_SUITE_P(
    Hands, PublishedHandTest,
    testing::Values(
        Published{"allegro_hand/allegro_hand_right.urdf", "FF MF RF TH! ", {1, 0, 0}, 16},
        Published{"barrett_hand/bhand_model.urdf", "FF MF TH! ", {0, 0, 1}, 8}));

std::string ErrorOf(const std::string& urdf) {
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(urdf, MakeSourceWithoutMeshes(), "", problems);
  EXPECT_TRUE(imported.files.empty());
  for (const Diagnostic& problem : problems.entries()) {
    if (problem.severity == Severity::kError) return problem.text;
  }
  return "";
}

/** The gripper with all its lengths times a factor. */
std::string Scale(const std::string& from, const std::string& to) {
  std::string text = kSmallGripper;
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

TEST(ImportHandTest, AHandInAnotherUnitIsRefused) {
  const std::string message =
      " m across; a hand is 15 mm to 2 m with its forearm. URDF is in metres: the unit of its "
      "origins and shapes is another";
  EXPECT_EQ(ErrorOf(Scale("xyz=\"0 0 0.06\"", "xyz=\"0 60 60\"")), "the hand is 60.1" + message);
  std::string tiny = kSmallGripper;
  for (const auto& [from, to] : {std::pair{"0.06 0.2 0.06", "0.00006 0.0002 0.00006"},
                                 {"0 0 0.03\"", "0 0 0.00003\""},
                                 {"0.02 0.015 0.055", "0.00002 0.000015 0.000055"},
                                 {"0.02 0.015 0.055", "0.00002 0.000015 0.000055"},
                                 {"0 0.0085 0.03", "0 0.0000085 0.00003"},
                                 {"0 -0.0085 0.03", "0 -0.0000085 0.00003"},
                                 {"0 0 0.06", "0 0 0.00006"},
                                 {"0 0 0.06", "0 0 0.00006"}}) {
    tiny = ReplaceOnce(tiny, from, to);
  }
  EXPECT_EQ(ErrorOf(tiny), "the hand is 0.0002" + message);
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
  EXPECT_EQ(imported.files.size(), 3u);
}

}  // namespace
}  // namespace graspbench
