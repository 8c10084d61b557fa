#pragma once
/** @file
Inverse kinematics of pads on an object; the objective is described in transfer_grasp.h. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/transfer/transfer_grasp.h"

namespace graspbench {

/** Pose of the hand and its joint positions. */
struct PlacedPosture {
  Pose X_OH = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints)
};

struct PadTask {
  std::vector<PadGoal> goals;
  /** All joints; those of no digit keep these values. */
  Eigen::VectorXd q_standard;
  double to_standard = 2.0;   ///< tolerated deviation of a joint from it, in units of its range
  double collision = 0.001;   ///< tolerated depth of a link [m]
  bool moves_hand = true;     ///< else only joints move
  double pad_length = 0.001;  ///< tolerated distance of a pad from its goal [m]
  /** Clearance of all links from the object [m]; 0: fingertips with goals may penetrate by
  kTipSink. */
  double room = 0.0;
  /** Unit direction from the centre of the pads to the palm; unset: any. */
  std::optional<Eigen::Vector3d> palm_O;
};

inline constexpr double kTipSink = 0.002;  ///< by which a ball protrudes from the pad's surface [m]

class PadPlacer {
 public:
  /** @pre the object has its distance field; both outlive this object. */
  PadPlacer(const Hand& hand, const GraspObject& object);

  /** @param cost  root of the summed squared residuals.  @param calls  largest number of
  evaluations. */
  PlacedPosture Place(const PadTask& task, const PlacedPosture& start, int calls,
                      double& cost) const;
  /** Starts from several poses around the opposition axis, or about the palm's direction, each with
  the standard posture and one nearer to the middle of the joint ranges. */
  PlacedPosture PlaceAnywhere(const PadTask& task) const;

  std::vector<PadMiss> CalcMisses(const std::vector<PadGoal>& goals,
                                  const PlacedPosture& placed) const;
  /** Describes the deepest penetration of a link above `allowed` [m] into the object, the table or
  another link: "ffproximal is 3.1 mm inside the object". Fingertips of `goals` may penetrate the
  object by kTipSink more. */
  std::string FindCollision(const std::vector<PadGoal>& goals, const PlacedPosture& placed,
                            double allowed) const;
  /** Least height of the hand above the table [m]. */
  double CalcTableRoom(const PlacedPosture& placed) const;
  /** Names of the goals' joints that the pads do not determine. */
  std::vector<std::string> FindUndetermined(const std::vector<PadGoal>& goals,
                                            const PlacedPosture& placed) const;

 private:
  struct Depths;
  struct Functor;
  Depths CalcDepths(const PlacedPosture& placed, const std::vector<Pose>& X_HL) const;
  Eigen::VectorXd BendTowardsMiddle(const Eigen::VectorXd& q, double share) const;
  std::vector<bool> FindTips(const std::vector<PadGoal>& goals) const;
  void AddResiduals(const PadTask& task, const PlacedPosture& placed,
                    const std::vector<bool>& is_tip, Eigen::VectorXd& residuals,
                    Eigen::Index& next) const;

  const Hand& hand_;
  const GraspObject& object_;
  std::vector<CapsulePair> pairs_;
};

}  // namespace graspbench
