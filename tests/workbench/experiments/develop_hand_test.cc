#include "workbench/experiments/develop_hand.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/hand/import/import_hand.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class DevelopHandTest : public testing::Test {
 protected:
  DevelopHandTest() {
    Diagnostics problems;
    const ImportedFiles imported =
        ImportHand(kSmallGripper, MakeSourceWithoutMeshes(), "", problems);
    MakeFolder(folder_.path() / "gripper");
    for (const auto& [name, content] : imported.files) {
      WriteFile(folder_.path() / "gripper" / name, content);
    }
  }
  fs::path out(const char* name) const { return folder_.path() / name; }
  std::vector<DevelopedGrasp> Develop(const char* name, int num_workers) {
    DevelopHandRequest request;
    request.hand = (folder_.path() / "gripper").string();
    request.out = out(name);
    request.config.budget = 100;
    request.num_workers = num_workers;
    Observer observer;
    return DevelopHand(request, observer, stop_);
  }

  TemporaryFolder folder_;
  std::atomic<bool> stop_{false};
};

TEST_F(DevelopHandTest, AGripperGetsItsGraspsWhateverTheWorkersAndWhereverItStopped) {
  const std::vector<DevelopedGrasp> developed = Develop("one", 1);
  ASSERT_EQ(developed.size(), 3u);  // g2, g3, g4: with two digits
  const std::vector<Grasp> read = LoadStandardGrasps(LoadHand(out("one").string()));
  ASSERT_EQ(read.size(), 3u);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read[k].id, developed[k].grasp.id);
    EXPECT_EQ(read[k].q_target, developed[k].grasp.q_target);
  }
  const std::string yaml = ReadFile(out("one") / "hand.yaml");
  const std::string journal = ReadFile(out("one") / "development" / "journal.jsonl");
  const std::string result = ReadFile(out("one") / "development" / "result.json");

  // Stopped at once, then in the middle of a line, as by a kill.
  stop_ = true;
  EXPECT_THROW(Develop("two", 2), Error);
  stop_ = false;
  WriteFile(out("two") / "development" / "journal.jsonl", journal.substr(0, journal.size() / 2));
  Develop("two", 2);
  EXPECT_EQ(ReadFile(out("two") / "development" / "journal.jsonl"), journal);
  EXPECT_EQ(ReadFile(out("two") / "development" / "result.json"), result);
  EXPECT_EQ(ReadFile(out("two") / "hand.yaml"), yaml);
}

TEST_F(DevelopHandTest, AStopLeavesTheHandAsItWasAndIsSaid) {
  stop_ = true;
  try {
    Develop("stopped", 1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInterrupted);
  }
  EXPECT_EQ(ReadFile(out("stopped") / "hand.yaml"),
            ReadFile(folder_.path() / "gripper" / "hand.yaml"));
}

TEST_F(DevelopHandTest, AFolderWithOtherThingsIsRefused) {
  MakeFolder(out("mine"));
  WriteFile(out("mine") / "letter.txt", "dear");
  EXPECT_THROW(Develop("mine", 1), Error);
  EXPECT_EQ(ReadFile(out("mine") / "letter.txt"), "dear");
}

TEST_F(DevelopHandTest, TheHandsOwnFolderIsRefused) {
  MakeFolder(out("gripper") / "below");
  for (const char* name : {"gripper", "gripper/developed", "gripper/below/../new"}) {
    try {
      Develop(name, 1);
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    }
    EXPECT_FALSE(fs::exists(out(name) / "development")) << name;
  }
}

}  // namespace
}  // namespace graspbench
