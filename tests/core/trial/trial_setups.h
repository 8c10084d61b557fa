#pragma once
/** @file
Trials for the tests of the engine. */

#include <gtest/gtest.h>

#include <memory>

#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

/** A cube of 31 mm. */
inline std::shared_ptr<const GraspObject> MakeCube(double mass, double mu) {
  GraspObject object =
      MakeSolid(MakeRoundedBox(Eigen::Vector3d::Constant(0.031), 0.001, 2), mass, mu, mu);
  object.id = "cube";
  return std::make_shared<const GraspObject>(object);
}

/** The grasp of this id, without variation. */
inline TrialSetup MakeSetup(std::shared_ptr<const Hand> hand, const std::string& grasp,
                            std::shared_ptr<const GraspObject> object) {
  TrialSetup setup;
  setup.hand = std::move(hand);
  setup.object = std::move(object);
  for (const Grasp& candidate : LoadStandardGrasps(*setup.hand)) {
    if (candidate.id == grasp) setup.grasp = candidate;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  return setup;
}

inline TrialSetup MakeSetup(const char* hand, const char* grasp,
                            std::shared_ptr<const GraspObject> object) {
  return MakeSetup(std::make_shared<const Hand>(LoadHand(hand)), grasp, std::move(object));
}

inline TrialResult RunSetup(const TrialSetup& setup) {
  return TrialRunner(setup.hand, setup.object).Run(setup);
}

inline void ExpectSurvivesItsRecord(const TrialResult& result) {
  EXPECT_EQ(ToJson(TrialResultFromJson(ToJson(result))), ToJson(result));
}

}  // namespace graspbench
