#pragma once
/** @file
The rules by which postures of a grasp are found from a hand's geometry alone, before anything is
simulated, as residuals that a least-squares solver makes small:

    opening      thumb pad and middle of the finger pads stand as far apart as asked, open and met
    opposition   the pads face each other
    level        all pads stand at one height over the table, and stay there while they close
    straight     pads close along the opposition axis, not aside
    in line      the fingers' pads stand side by side, in one plane across the opposition axis
    side by side neighbouring pads do not meet, and stand no wider than a small thing
    tips down    fingertips point to the table, and nothing of the hand reaches deeper than they do
    reach        the palm stays as far above the pads as asked
    over palm    pads that are to press a thing into the palm meet under its middle
    share        the thumb does its share of the way
    ease         joints stay off their limits and near their rest

A pair of postures is sought at once: the open one, from which the hand closes, and that in which
the pads (nearly) meet. "Height" is along the approach. Proposed by graspbench after the titles of
the thesis's development rules (section 3.2.4); its text is not known. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/develop/hand_pads.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** What is asked of a grasp. */
struct PostureAim {
  std::vector<std::string> digits;  ///< the opposing one among them
  double opening = 0.08;            ///< between the pads when open [m]
  double meeting = 0.008;           ///< when closed [m]
  double thumb_share = 0.5;         ///< of the way that the pads come together
  bool by_side = false;             ///< fingers take with their sides; the thumb with its pad
  double reach = 0.05;              ///< of the pads beyond the palm [m]
  bool is_reach_exact = false;      ///< else at least
  bool is_over_palm = false;        ///< they meet under the middle of the palm
  double lift = 0.0;                ///< by which met pads face up, towards the palm [rad]
  double tips_down = 0.5;           ///< least cosine of fingertips to the approach
  double pad_gap = 0.02;            ///< between the middles of neighbouring pads [m]
  bool leaders_straight = false;    ///< joints that others follow stay near zero
};

/** Postures that are sought. */
struct PosturePair {
  Eigen::VectorXd q_open;  ///< (num_joints)
  Eigen::VectorXd q_met;   ///< (num_joints)
  double tilt = 0.0;       ///< [rad]
};

class PostureRules {
 public:
  /** @param q_rest  posture of the joints that do not grasp. @pre the hand has the aim's digits. */
  PostureRules(const Hand& hand, const PostureAim& aim, const Eigen::VectorXd& q_rest);

  /** Coordinates x of a pair: grasping joints open, then met, each 0 at its lower limit and 1 at its
  upper one, then the tilt in radians. */
  int num_coordinates() const { return 2 * static_cast<int>(joints_.size()) + 1; }
  PosturePair MakePair(const Eigen::VectorXd& x) const;
  Eigen::VectorXd MakeCoordinates(const PosturePair& pair) const;

  int num_residuals() const;
  /** Of the met posture: the largest angle between what takes (pad or side) and the way to what it
  opposes [rad]. */
  double CalcWorstFacing(const PosturePair& pair) const;
  /** Each is about 1 where a rule is missed by as much as matters. */
  Eigen::VectorXd CalcResiduals(const Eigen::VectorXd& x) const;

 private:
  struct Stand;  // what the rules ask of one posture
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
  std::vector<bool> is_tip_;   // by link: carries a pad that grasps
  std::vector<double> sides_;  // of opposing_ and fingers_: 0 takes with its pad; see CalcSideState
  Eigen::Vector3d normal_H_, forward_H_;
};

}  // namespace graspbench
