#include "core/hand/import/guess_hand.h"

#include <gtest/gtest.h>

#include "core/base/files.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

/** A hand of the project, as its bare URDF would be imported. */
Hand ImportModel(const std::string& id, Diagnostics& problems) {
  const std::filesystem::path folder = FindDataRoot() / "core/hand/models" / id;
  HandSource source = MakeSourceWithoutMeshes();
  source.file = "hand.urdf";
  source.folder = folder;
  const ImportedFiles imported = ImportHand(ReadFile(folder / "hand.urdf"), source, "", problems);
  if (imported.files.empty()) return {};
  const std::filesystem::path out = std::filesystem::path(testing::TempDir()) / ("guess_" + id);
  MakeFolder(out);
  for (const char* name : {"hand.urdf", "hand.yaml"}) {
    WriteFile(out / name, imported.files.at(name));
  }
  return LoadHand(out.string());
}

class KnownHandTest : public testing::TestWithParam<const char*> {};

// hand.yaml of these hands was written by people who knew the hand: the truth for the guesses.
TEST_P(KnownHandTest, IsGuessedAsItsMakersDescribeIt) {
  const Hand known = LoadHand(GetParam());
  Diagnostics problems;
  const Hand guessed = ImportModel(GetParam(), problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(guessed.links[guessed.palm_link].name, known.links[known.palm_link].name);
  EXPECT_GT(guessed.palm_normal.dot(known.palm_normal), 0.95) << guessed.palm_normal.transpose();
  ASSERT_EQ(guessed.digits.size(), known.digits.size());
  for (size_t d = 0; d < known.digits.size(); ++d) {
    const Digit &a = guessed.digits[d], &b = known.digits[d];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.is_thumb, b.is_thumb) << a.id;
    EXPECT_EQ(a.links.size(), b.links.size()) << a.id;
    EXPECT_EQ(guessed.links[a.distal_link].name, known.links[b.distal_link].name);
    // The shapes of the Shadow Hand's thumb end 6.5 mm before the tip of its maker's figures.
    EXPECT_LT((a.p_LTip - b.p_LTip).norm(), 0.008) << a.id << " " << a.p_LTip.transpose();
    EXPECT_LT((a.p_LPad - b.p_LPad).norm(), 0.008) << a.id << " " << a.p_LPad.transpose();
  }
}
INSTANTIATE_TEST_SUITE_P(Models, KnownHandTest, testing::Values("tum", "tum-original", "shadow"));

}  // namespace
}  // namespace graspbench
