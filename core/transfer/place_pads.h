#pragma once
/** @file
Inverse kinematics of pads on an object: see transfer_grasp.h for what is made small. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/transfer/transfer_grasp.h"

namespace graspbench {

/** Where the hand is and how it is bent. */
struct PlacedPosture {
  Pose X_OH = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints)
};

struct PadTask {
  std::vector<PadGoal> goals;
  /** All joints; those that are of no digit stay so. */
  Eigen::VectorXd q_standard;
  double to_standard = 2.0;   ///< by which a joint may differ from it, of its range
  double collision = 0.001;   ///< depth of a link that matters [m]
  bool moves_hand = true;     ///< else joints alone
  double pad_length = 0.001;  ///< by which a pad may miss before it matters [m]
  /** Of all links beside the object [m]; 0: fingertips with goals may sink in by kTipSink. */
  double room = 0.0;
  /** Unit, from the pads' middle to the palm; none: anywhere. */
  std::optional<Eigen::Vector3d> palm_O;
};

inline constexpr double kTipSink = 0.002;  ///< a ball stands out of the pad's surface [m]

class PadPlacer {
 public:
  /** @pre the object has its distance field; both outlive this. */
  PadPlacer(const Hand& hand, const GraspObject& object);

  /** @param cost  root of the summed squared residuals.  @param calls  of the rules, at most. */
  PlacedPosture Place(const PadTask& task, const PlacedPosture& start, int calls,
                      double& cost) const;
  /** From starts all round the opposition axis, or about the palm's direction, with the standard
  posture and one nearer to the middle of the joints' ranges. */
  PlacedPosture PlaceAnywhere(const PadTask& task) const;

  std::vector<PadMiss> CalcMisses(const std::vector<PadGoal>& goals,
                                  const PlacedPosture& placed) const;
  /** The link that is deepest in the object (fingertips of `goals` by more than kTipSink), in the
  table or in another, by more than `allowed` [m]: "ffproximal is 3.1 mm inside the object". */
  std::string FindCollision(const std::vector<PadGoal>& goals, const PlacedPosture& placed,
                            double allowed) const;
  /** Smallest height of the hand above the table [m]. */
  double CalcTableRoom(const PlacedPosture& placed) const;
  /** Names of the goals' joints that the pads leave open. */
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
