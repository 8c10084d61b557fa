#pragma once
/** @file
A small gripper that is developed into folders of its own. */

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "core/base/files/files.h"
#include "core/hand/import/import_hand.h"
#include "tests/core/hand/import/small_gripper.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/develop_hand.h"

namespace graspbench {

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
  std::filesystem::path out(const char* name) const { return folder_.path() / name; }
  std::vector<DevelopedGrasp> Develop(const char* name, int num_workers) {
    DevelopHandRequest request;
    request.hand = (folder_.path() / "gripper").string();
    request.out = out(name);
    request.config.budget = 100;
    request.num_workers = num_workers;
    Observer observer(stop_);
    return DevelopHand(request, observer);
  }

  TemporaryFolder folder_;
  std::atomic<bool> stop_{false};
};

}  // namespace graspbench
