#pragma once
/** @file
Grasps fitted to objects, each found once for a session and shared by threads. */

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

#include "core/grasp/predict_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** A standard grasp on one object. */
struct FittedGrasp {
  Grasp grasp;                 ///< as the hand does it there
  GraspPrediction prediction;  ///< of it
};

class FittedGrasps {
 public:
  using Key = std::tuple<std::shared_ptr<const Hand>, std::shared_ptr<const GraspObject>,
                         std::string>;  ///< with the grasp's id

  /** What `make` gives for a new key; the reference stays valid. */
  const FittedGrasp& Find(const Key& key, const std::function<FittedGrasp()>& make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (const auto found = fitted_.find(key); found != fitted_.end()) return found->second;
    }
    FittedGrasp made = make();
    const std::lock_guard<std::mutex> lock(mutex_);
    return fitted_.emplace(key, std::move(made)).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, FittedGrasp> fitted_;
};

}  // namespace graspbench
