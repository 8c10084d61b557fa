#include "datasets/judged_grasps/profile_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"

namespace graspbench {
namespace {

std::string FindFault(const std::string& text) {
  try {
    ParseProfile(text, "mine.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ProfileFile, ShippedProfilesNameTheirSource) {
  std::set<std::string> names;
  for (const FreeSpaceProfile& profile : ListProfiles()) {
    names.insert(profile.name);
    EXPECT_FALSE(profile.about.empty()) << profile.name;
    EXPECT_FALSE(profile.source.empty()) << profile.name;
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"dexgraspbench-fc", "dexgraspbench-tabletop", "dexgraspnet",
                                   "multigripper", "multigripper-axes", "own"}));
}

// A later default must not change what somebody means by a name.
TEST(ProfileFile, ShippedProfilesWriteEveryKey) {
  for (const FreeSpaceProfile& profile : ListProfiles()) {
    const YAML::Node root =
        YAML::Load(ReadFile(FindDataRoot() / "datasets" / "profiles" / (profile.name + ".yaml")));
    for (const std::string& key : ListConfigKeys(profile)) {
      EXPECT_GT(FindConfigLine(root, key), 0) << profile.name << " lacks " << key;
    }
  }
}

TEST(ProfileFile, DexGraspBenchAsPublished) {
  const FreeSpaceProfile profile = LoadProfile("dexgraspbench-fc");
  EXPECT_EQ(profile.drives.stiffness, 5.0);
  EXPECT_EQ(profile.surfaces.friction, 0.6);
  EXPECT_NEAR(profile.surfaces.friction * profile.surfaces.torsion_radius, 0.02, 1e-6);
  EXPECT_EQ(profile.sim.step, 0.004);
  EXPECT_EQ(profile.mass, 0.1);
  EXPECT_EQ(profile.acceleration, 10.0);
  EXPECT_EQ(profile.test_time, 2.0);
  EXPECT_EQ(profile.max_shift, 0.05);
  EXPECT_EQ(profile.max_turn_deg, 15.0);
}

TEST(ProfileFile, DexGraspNetAsPublished) {
  const FreeSpaceProfile profile = LoadProfile("dexgraspnet");
  EXPECT_EQ(profile.drives.stiffness, 1000.0);
  EXPECT_EQ(profile.surfaces.friction, 3.0);
  EXPECT_EQ(profile.mass, 0.0);
  EXPECT_EQ(profile.density, 500.0);
  EXPECT_EQ(profile.acceleration, 9.8);
  EXPECT_NEAR(profile.test_time, 100.0 / 60.0, 1e-5);
  EXPECT_NEAR(8.0 * profile.sim.step, 1.0 / 60.0, 1e-7);
  EXPECT_EQ(profile.max_start_penetration, 0.001);
  EXPECT_TRUE(profile.must_touch);
  EXPECT_EQ(profile.closing.to, "press");
}

TEST(ProfileFile, MultiGripperGraspAsPublished) {
  const FreeSpaceProfile fall = LoadProfile("multigripper");
  EXPECT_EQ(fall.test, "fall");
  EXPECT_EQ(fall.acceleration, 9.81);
  EXPECT_EQ(fall.test_time, 3.0);
  EXPECT_EQ(fall.max_shift, 0.3);
  EXPECT_EQ(fall.closing.to, "limits");
  EXPECT_TRUE(fall.closing.object_is_held);
  EXPECT_EQ(fall.stage_time, 0.7);
  const FreeSpaceProfile axes = LoadProfile("multigripper-axes");
  EXPECT_EQ(axes.test, "pushes");
  EXPECT_FALSE(axes.closing.object_is_held);
  EXPECT_EQ(axes.acceleration, 0.5);
  EXPECT_EQ(axes.test_time, 0.5);
  EXPECT_EQ(axes.max_shift, 0.02);
}

TEST(ProfileFile, OwnHoldsTheDefaults) {
  FreeSpaceProfile own = LoadProfile("own");
  own.about = own.source = "";
  FreeSpaceProfile defaults;
  defaults.sim.steady_step_factor = 1;
  defaults.finds_breaking_load = true;  // its cost is asked for, not had by chance
  EXPECT_EQ(FindConfigDifferences(own, defaults), std::vector<std::string>());
}

TEST(ProfileFile, FaultsAreNamedWithTheirLine) {
  EXPECT_TRUE(Has(FindFault("about: x\nfrictoin: 1\n"), "mine.yaml:2"));
  EXPECT_TRUE(Has(FindFault("test: shakes\n"), "expected pushes, fall, lift"));
  EXPECT_TRUE(Has(FindFault("stage_time_s: -1\n"), "out of range"));
  EXPECT_TRUE(Has(FindFault("drives: {law: hers}\n"), "expected own, given"));
  EXPECT_EQ(FindFault("about: mine\n"), "");
  EXPECT_TRUE(Has(FindFault(""), "no profile"));
  EXPECT_TRUE(Has(FindFault("\xff\xfe"), "mine.yaml"));
  EXPECT_TRUE(Has(FindFault("test: lift\nlift_height_m: 0.04\n"), "above max_shift_m"));
  for (const char* idle : {"test: lift\n", "acceleration_m_per_s2: 0\n"}) {
    EXPECT_TRUE(Has(FindFault(std::string("finds_breaking_load: true\n") + idle), "needs pushes"));
  }
  EXPECT_THROW(LoadProfile("dexgraspbenhc-fc"), Error);
}

TEST(ProfileFile, NothingFallsByItself) {
  EXPECT_EQ(ParseProfile("about: mine\n", "mine.yaml").sim.gravity, 0.0);
  EXPECT_TRUE(Has(FindFault("sim: {gravity_m_per_s2: 9.81}\n"), "acceleration_m_per_s2 states"));
}

TEST(ProfileFile, AFileDoesNotPassForAShippedProfile) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "profile_file_test";
  MakeFolder(folder);
  const std::string own = (folder / "own.yaml").string();
  WriteFile(own, "surfaces: {friction: 0}\n");
  EXPECT_TRUE(Throws([&] { LoadProfile(own); }, ErrorKind::kUsage));
  WriteFile(own, ReadFile(FindDataRoot() / "datasets" / "profiles" / "own.yaml"));
  EXPECT_EQ(LoadProfile(own).name, "own");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace graspbench
