#pragma once
/** @file
Rules by which postures of a grasp are found from a hand's geometry alone, before any simulation, as
residuals that a least-squares solver minimises:

    opening      the thumb pad and the centre of the finger pads have the required distance, open
                 and met
    opposition   the pads face each other
    level        all pads are at one height above the table, and stay there while they close
    straight     pads close along the opposition axis, not sideways
    in line      the fingers' pads are side by side, in one plane across the opposition axis
    side by side neighbouring pads neither touch nor are wider apart than a small object
    tips down    fingertips point to the table, and no other part of the hand is lower
    reach        the palm has the required distance above the pads
    over palm    pads that are to press an object into the palm meet under its centre
    share        the thumb covers its share of the distance
    ease         joints stay off their limits and near their rest position

Two postures are solved for at once: the open one, from which the hand closes, and the met one, in
which the pads (nearly) touch. "Height" is along the approach. Proposed by graspbench after the
titles of the thesis's development rules (section 3.2.4), whose text is not known. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/develop/hand_pads.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Requirements of a grasp. */
struct PostureAim {
  std::vector<std::string> digits;  ///< including the opposing one
  double opening = 0.08;            ///< between the pads when open [m]
  double meeting = 0.008;           ///< when closed [m]
  double thumb_share = 0.5;         ///< thumb's share of the distance that the pads close
  bool by_side = false;             ///< fingers grasp with their sides, the thumb with its pad
  double reach = 0.05;              ///< distance of the pads beyond the palm [m]
  bool is_reach_exact = false;      ///< else a minimum
  bool is_over_palm = false;        ///< pads meet under the centre of the palm
  double lift = 0.0;                ///< angle by which met pads face up, towards the palm [rad]
  double tips_down = 0.5;           ///< least cosine of fingertips and approach
  double pad_gap = 0.02;            ///< between the centres of neighbouring pads [m]
  bool leaders_straight = false;    ///< joints that others follow stay near zero
};

/** The two postures to be found. */
struct PosturePair {
  Eigen::VectorXd q_open;  ///< (num_joints)
  Eigen::VectorXd q_met;   ///< (num_joints)
  double tilt = 0.0;       ///< [rad]
};

class PostureRules {
 public:
  /** @param q_rest  posture of the other joints. @pre the hand has the aim's digits. */
  PostureRules(const Hand& hand, const PostureAim& aim, const Eigen::VectorXd& q_rest);

  /** Number of coordinates x of a pair: the grasping joints when open, then when met, each 0 at its
  lower and 1 at its upper limit, then the tilt in radians. */
  int num_coordinates() const { return 2 * static_cast<int>(joints_.size()) + 1; }
  PosturePair MakePair(const Eigen::VectorXd& x) const;
  Eigen::VectorXd MakeCoordinates(const PosturePair& pair) const;

  int num_residuals() const;
  /** Largest angle, in the met posture, between the normal of a grasping pad or side and the
  direction to the opposing one [rad]. */
  double CalcWorstFacing(const PosturePair& pair) const;
  /** Each residual is about 1 for a relevant deviation from a rule. */
  Eigen::VectorXd CalcResiduals(const Eigen::VectorXd& x) const;

 private:
  struct Stand;  // quantities of one posture that the rules use
  void FindSides();
  PadState CalcPad(const Digit& digit, double side, const std::vector<Pose>& X_HL) const;
  Stand CalcStand(const Eigen::VectorXd& q, const Eigen::Vector3d& approach_H) const;
  void AddStand(const Stand& stand, const Eigen::Vector3d& approach_H, bool is_open, double opening,
                std::vector<double>& residuals) const;

  const Hand& hand_;
  PostureAim aim_;
  Eigen::VectorXd q_rest_;
  std::vector<int> joints_;
  std::vector<const Digit*> fingers_;  // without the opposing digit
  const Digit* opposing_;
  std::vector<bool> is_tip_;   // by link: carries a grasping pad
  std::vector<double> sides_;  // of opposing_ and fingers_: 0: grasps with its pad; see
                               // CalcSideState
  Eigen::Vector3d normal_H_, forward_H_;
};

}  // namespace graspbench
