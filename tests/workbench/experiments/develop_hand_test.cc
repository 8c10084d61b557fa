#include "workbench/experiments/develop_hand.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/workbench/experiments/develop_gripper.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

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
