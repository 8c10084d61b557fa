#pragma once
/** @file
Hands, objects and results made up for the tests of sessions: nothing is loaded or simulated. */

#include <cstdlib>
#include <filesystem>
#include <string>

#include "datasets/plan/session_inputs.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** A folder of its own, removed with the object. */
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "graspbench_XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/** "tum" (two joints, the second coupled; 2 degrees of joint error; g1, g2) and "shadow" (three
joints; g1 to g5); objects "mug" (best g2 and g3) and "pencil" (best g2 for "tum" only). */
SessionInputs MakeFakeInputs();
SessionHand MakeFakeHand(const std::string& id, int num_joints, double joint_accuracy,
                         const std::vector<std::string>& grasps);
std::shared_ptr<GraspObject> MakeFakeObject(const std::string& id);

/** A result that depends on the trial's id only. Every field has a value somewhere; outcomes,
missing contacts and awkward texts occur. */
TrialRecord MakeFakeRecord(const PlannedTrial& planned);

/** Creates the session of the fake inputs and returns its plan. */
std::vector<PlannedTrial> CreateFakeSession(const std::filesystem::path& folder, int trials);

}  // namespace graspbench
