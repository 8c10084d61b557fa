#pragma once
/** @file
A person's grasp on a robot hand: where a person's digits touched the object becomes a posture and a
place of any hand.

    pairing   digits of person and hand in the order thumb, index .. little. The hand's first fingers
              stand for one finger each, its last one for all that are left: a virtual finger, whose
              pad is the mean of theirs, projected onto the surface (PairDigits)
    contact   least squares over the hand's pose and its digits' joints (Levenberg-Marquardt, within
              limits and couplings): distance of each pad from its goal over 1 mm, difference of
              directions over 0.2 where they were measured, else over 0.7, measured directions of
              last phalanges over 0.7, links inside object, table
              and each other over 1 mm, direction to the palm over 0.5, distance from the standard
              grasp's joints over two of their ranges. So pads come first, and what they leave open
              goes to the standard grasp
    opening   joints alone: pads as far from their contacts as the person's at the widest opening,
              clear of object and table
    target    on the line from the opening through the contact, until every pad is kPlacementOffset
              behind the surface; then the squeeze by statics (CalcSqueeze,
              core/develop/propose_grasps.h). Opening and target are then moved, within limits, so
              that the closing hand passes through the contact; where that opening is in the way,
              the target goes straight on from the opening as far

The person's hand is scaled by what is held: contacts stay where they are on the object. A pad
farther than kReachedMiss from its goal is unreachable, and its digit leaves the grasp; without two
digits, the opposing one among them, the grasp is not transferable. Proposed by graspbench. Virtual
fingers: Arbib, Iberall and Lyons 1985.

Frames: O is the object's, at rest on the table with its axes parallel to W's.

Not modelled: forces, rolling of pads, skin. A marker stands for the nearest point of the surface. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kReachedMiss = 0.005;   ///< farther pads are unreachable [m]
inline constexpr double kPadShare = 0.4;        ///< of the last phalanx, from tip to pad
inline constexpr double kFarthestPad = 0.03;    ///< from the bone to the surface [m]
inline constexpr double kPadTolerance = 0.002;  ///< within this a pad is where the person's was [m]

/** One digit of a person. Places are markers or landmarks: the pad's goal is the nearest point of
the surface. */
struct PersonDigit {
  std::string digit;                              ///< "TH", "FF", "MF", "RF", "LF"
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  ///< at contact [m]
  /** From there to where it was at the widest opening, in the hand's own frame [m]. */
  Eigen::Vector3d opening_O = Eigen::Vector3d::Zero();
  /** Unit, out of the pad; zero: not measured, then against the surface's normal. */
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();
  /** Unit, along the last phalanx to its tip; zero: not measured. */
  Eigen::Vector3d axis_O = Eigen::Vector3d::Zero();
  /** Landmarks of its joints, from the palm to the last; empty: one marker. p_O is the tip then. */
  std::vector<Eigen::Vector3d> p_OJoints = {};
};

struct PersonGrasp {
  std::vector<PersonDigit> digits;  ///< those that touched, thumb first, then radial to ulnar
  /** Of the palm at contact: the mean of wrist and knuckles, else a wrist marker [m]. */
  std::optional<Eigen::Vector3d> p_OPalm;
  /** Unit: where the hand moved on its way to the object; zero: not known. */
  Eigen::Vector3d approach_O = Eigen::Vector3d::Zero();
};

/** At the widest opening, a rigid hand: the opening axis (thumb to the mean of the fingers) is
turned by the smallest rotation to where it is at contact, its middle shifted there. What is left of
each digit is its opening_O. @pre as many places as digits, the thumb first. */
void SetOpening(const std::vector<Eigen::Vector3d>& p_OOpen, PersonGrasp& person);

/** What the joints' landmarks say. The pad lies kPadShare of the last phalanx before the tip. It
faces across the phalanx, in the plane in which the digit bends; a straight digit's faces the surface
as far as it can. It touches the surface where that direction meets it, within kFarthestPad, else at
the nearest point. Digits without landmarks stay as they are. @pre FindPersonFault is empty. */
PersonGrasp UseLandmarks(const PersonGrasp& person, const GraspObject& object);

/** Why a recorded grasp cannot be a person's on this object: too few digits, a digit far from the
surface (wrong unit, object pose missing or of another trial), digits exchanged, joints of another
digit. Empty: it can. */
std::string FindPersonFault(const PersonGrasp& person, const GraspObject& object);

/** +1: a left hand, -1: a right hand, 0: not known. By the palm, behind a thumb and two fingers. */
int FindHandedness(const PersonGrasp& person);
int FindHandedness(const Hand& hand, const Grasp& standard);

/** What one digit of the hand stands for. */
struct PadGoal {
  int digit = -1;                                    ///< index into Hand::digits
  std::string person;                                ///< "RF", "MF+RF+LF"
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();     ///< on the surface [m]
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();  ///< unit, out of the pad
  bool is_direction_measured = false;
  Eigen::Vector3d axis_O = Eigen::Vector3d::Zero();  ///< unit, as the person's; zero: any
  Eigen::Vector3d opening_O = Eigen::Vector3d::Zero();
};
/** @param reverse  the hand's fingers in the reverse order: of a hand with two fingers, which may
take either place. @pre FindPersonFault is empty; the object has its distance field. */
std::vector<PadGoal> PairDigits(const Hand& hand, const PersonGrasp& person,
                                const GraspObject& object, bool reverse = false);

/** How far a pad is from the person's. */
struct PadMiss {
  std::string digit, person;
  double distance = 0.0;  ///< [m]
  double angle = 0.0;     ///< between the directions [rad]
  bool is_reached() const { return distance <= kReachedMiss; }
};

struct TransferredGrasp {
  std::string not_transferable;  ///< the reason; empty: it is
  Grasp grasp;                   ///< with placement, for this object alone
  std::string standard;          ///< id of the standard grasp it goes towards
  Eigen::VectorXd q_contact;     ///< (num_joints)
  /** At contact; then those of digits that left the grasp. */
  std::vector<PadMiss> pads;
  double room = 0.0;  ///< of the open digits beside the object, draws included, at worst [m]
  /** Joints of the grasp that pads and measured directions leave open, by name. */
  std::vector<std::string> undetermined;
};

/** @param standard  the hand's standard grasps. @pre the object has its distance field. */
TransferredGrasp TransferGrasp(const Hand& hand, const std::vector<Grasp>& standard,
                               const PersonGrasp& person, const GraspObject& object);

}  // namespace graspbench
