#include "core/develop/write_grasps.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/files/files.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

TEST(ReplaceGraspsTest, LeavesAllElseAsItStands) {
  const std::string section =
      "# Standard grasps made by graspbench hand develop, seed 1\n# more\n"
      "grasps:\n  g2:\n    tilt_deg: 1\n";
  const std::string head = "name: hand  # its name\n\n# a comment\ndrives:\n  - joints: [a]\n";
  const std::string once = ReplaceGrasps(head + "\n# grasps: none yet; see the README\n", section);
  EXPECT_EQ(once, head + "\n" + section);
  EXPECT_EQ(ReplaceGrasps(once, section), once);
  EXPECT_EQ(ReplaceGrasps(head + "grasps:\n  g1:\n\n    tilt_deg: 2\nsurfaces: []\n", section),
            head + "surfaces: []\n\n" + section);
  EXPECT_EQ(ReplaceGrasps("name: no line feed", section), "name: no line feed\n\n" + section);
}

// Read back, the grasps are those that were tried, to the last bit.
TEST(FormatGraspsTest, AHandWithThemHasTheSameGrasps) {
  const Hand hand = LoadHand("tum");
  std::vector<DevelopedGrasp> developed;
  for (const char* id : {"g1", "g3"}) {
    DevelopedGrasp one;
    one.proposed =
        ProposeGrasps(hand, FindGraspTaxon(id), 5, 1, false, RandomStream("1", "test")).front();
    one.grasp = one.proposed.grasp;
    one.check = {{Outcome::kSuccess, 1.0}, {Outcome::kNoContact, 0.1}};
    developed.push_back(one);
  }
  developed.back().check.assign(12, {Outcome::kNoContact, 0.1});
  const fs::path folder = fs::path(testing::TempDir()) / "written_grasps";
  fs::remove_all(folder);
  fs::copy(hand.folder, folder, fs::copy_options::recursive);
  const std::string yaml =
      ReplaceGrasps(ReadFile(folder / "hand.yaml"), FormatGrasps(hand, DevelopConfig(), developed));
  EXPECT_NE(yaml.find("#   graspbench hand develop tum --budget 15000 --seed 1 --out DIR\n"),
            std::string::npos);
  EXPECT_NE(yaml.find("Held 1 of 2 shapes not met before."), std::string::npos);
  const size_t warning = yaml.find("  g3:\n    # WARNING: it held 0 of 12 shapes not met before");
  EXPECT_NE(warning, std::string::npos);
  EXPECT_EQ(yaml.find("WARNING"), yaml.find("WARNING", warning));  // g1 has none
  WriteFile(folder / "hand.yaml", yaml);
  const std::vector<Grasp> read = LoadStandardGrasps(LoadHand(folder.string()));
  ASSERT_EQ(read.size(), 2u);
  for (size_t k = 0; k < 2; ++k) {
    const Grasp& made = developed[k].grasp;
    EXPECT_EQ(read[k].id, made.id);
    EXPECT_EQ(read[k].q_pre, made.q_pre);
    EXPECT_EQ(read[k].q_target, made.q_target);
    EXPECT_EQ(read[k].tilt, made.tilt);
    EXPECT_EQ(read[k].palm_gap, made.palm_gap);
    EXPECT_EQ(read[k].digits, made.digits);
    EXPECT_EQ(read[k].palm_may_touch, made.id == "g3");
    EXPECT_EQ(read[k].held_share, made.id == "g3" ? 0.0 : 0.5);
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace graspbench
