#pragma once
/** @file
Standard grasps fitted to objects, with their predictions (core/grasp/predict_grasp.h). They are
computed once for a session, shared by its threads, and kept between runs (core/base/files/kept.h)
under a hash of the hand, the grasp, the object and the sources (core/base/version.h). */

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
  Grasp grasp;                 ///< as the hand performs it on the object
  GraspPrediction prediction;  ///< for `grasp`
};

class FittedGrasps {
 public:
  /** Returns the grasp fitted to the object. The reference stays valid. @param object  completed
  (CompleteObject) if needed. */
  const FittedGrasp& Find(const std::shared_ptr<const Hand>& hand, const Grasp& grasp,
                          const std::shared_ptr<const GraspObject>& object);

 private:
  using Key = std::tuple<std::shared_ptr<const Hand>, std::shared_ptr<const GraspObject>,
                         std::string>;  ///< with the grasp's id

  std::mutex mutex_;
  std::map<Key, FittedGrasp> fitted_;
};

}  // namespace graspbench
