#pragma once
/** @file
Standard grasps fitted to objects, with what is predicted of them (core/grasp/predict_grasp.h): found
once for a session, shared by its threads, and kept between runs (core/base/files/kept.h) under the
hash of the numbers of hand, grasp and object and of the sources (core/base/version.h). */

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

#include "core/grasp/predict_grasp.h"
#include "core/grasp/standard_grasp.h"
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
  /** The reference stays valid. @param object  completed where that is needed. */
  const FittedGrasp& Find(const std::shared_ptr<const Hand>& hand, const Grasp& grasp,
                          const std::shared_ptr<const GraspObject>& object);

 private:
  using Key = std::tuple<std::shared_ptr<const Hand>, std::shared_ptr<const GraspObject>,
                         std::string>;  ///< with the grasp's id

  std::mutex mutex_;
  std::map<Key, FittedGrasp> fitted_;
};

}  // namespace graspbench
