#pragma once
/** @file
Hand and object as a profile has them, and the stages of a grasp that the hand goes through. */

#include <memory>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/protocols/free_space_profile.h"

namespace graspbench {

/** What the hand is asked for at one stage of a grasp. */
struct ScriptedStage {
  std::string name;  ///< "pregrasp", "grasp", "squeeze"
  Pose X_OH = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints), followers too [rad], [m]
};

struct ProfiledScene {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  Pose X_WO = Pose::Identity();
  std::vector<ScriptedStage> stages;
  int num_beyond_limits = 0;  ///< joints that a stage asks for more than their limits
  std::string refusal;        ///< why the profile takes no such grasp; empty: it does
};

/** The hand with the profile's drives and surfaces. @param is_asked  by joint: the stages say where
it is; what they do not name is held as stiffly as the arm holds the hand. */
std::shared_ptr<const Hand> MakeProfiledHand(const Hand& hand, const FreeSpaceProfile& profile,
                                             const std::vector<bool>& is_asked);

/** The object with the profile's mass and friction; its inertia is scaled with the mass. */
std::shared_ptr<const GraspObject> MakeProfiledObject(const GraspObject& object,
                                                      const FreeSpaceProfile& profile);

/** @param hand, object  of MakeProfiledHand and MakeProfiledObject. @pre a stage at least. */
ProfiledScene MakeProfiledScene(std::shared_ptr<const Hand> hand,
                                std::shared_ptr<const GraspObject> object, const Pose& X_WO,
                                std::vector<ScriptedStage> stages, const FreeSpaceProfile& profile);

}  // namespace graspbench
