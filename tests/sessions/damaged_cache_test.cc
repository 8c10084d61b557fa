/** @file
One flipped bit in what is kept between runs (distance field, mesh check, fitted grasps) changes no
record: the program sees it, computes the result again and puts it back. */

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/random.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

// 40 x 40 x 50 mm; its field is made in no time.
const char kBlock[] =
    "v -20 -20 0\nv 20 -20 0\nv -20 20 0\nv 20 20 0\n"
    "v -20 -20 50\nv 20 -20 50\nv -20 20 50\nv 20 20 50\n"
    "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\n"
    "f 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";

class GRASPBENCH_SUITE : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(top_ / "block");
    ASSERT_EQ(::setenv("XDG_CACHE_HOME", (top_ / "cache").c_str(), 1), 0);
    WriteFile(top_ / "block" / "block.obj", kBlock);
    WriteFile(top_ / "block" / "object.yaml",
              "name: block\nmesh: block.obj\nmesh_unit: mm\nmass_kg: 0.05\n"
              "friction_static: 0.5\nfriction_dynamic: 0.4\n");
  }
  /** @returns the records of a session of one trial. */
  std::string RunTrial() const {
    const std::string folder = (top_ / "session").string();
    fs::remove_all(folder);
    EXPECT_EQ(WaitFor(Start({"run", "--plan-only", "--hand", "tum", "--trials", "1", "--object",
                             (top_ / "block").string(), "--set", "sim.step_s=0.004", "--set",
                             "strategy.hold_time_s=0.2", "--out", folder})),
              0);
    EXPECT_EQ(WaitFor(Start({"work", folder, "--shard", "1/1"})), 0);
    return ReadFile(fs::path(folder) / "journal" / "1of1-0.jsonl");
  }
  const TestFolder own_{"damaged_cache"};
  const fs::path& top_ = own_.path();
};

TEST_F(GRASPBENCH_SUITE, ChangesNoRecord) {
  const std::string records = RunTrial();
  ASSERT_NE(records.find("\"outcome\""), std::string::npos);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(top_ / "cache")) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 3u) << "a field, a mesh check and a fit at least";
  RandomStream random("damaged cache", "bit");
  for (int flip = 0; flip < GRASPBENCH_NUM_FLIPS; ++flip) {
    const fs::path& file = files[static_cast<size_t>(flip) % files.size()];
    const std::string whole = ReadFile(file);
    // Every second one in the header, which is a thousandth of a field.
    const size_t num_bytes = flip % 2 == 0 ? 24 : whole.size();
    const auto bit = static_cast<size_t>(random.NextIndex(static_cast<int>(8 * num_bytes)));
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    WriteFile(file, damaged);
    ASSERT_TRUE(RunTrial() == records) << file << ", bit " << bit;
    ASSERT_TRUE(ReadFile(file) == whole) << file << ", bit " << bit;
  }
}

}  // namespace
}  // namespace graspbench
