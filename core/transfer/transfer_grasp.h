#pragma once
/** @file
Transfers a human grasp to a robot hand: the contacts of a person's digits with the object become a
posture and a pose of any hand.

    pairing   digits of person and hand in the order thumb, index .. little. The first fingers of
              the hand represent one finger each, its last one all remaining: a virtual finger,
              whose pad is the mean of theirs, projected onto the surface (PairDigits)
    contact   least squares over the hand's pose and its digits' joints (Levenberg-Marquardt, within
              limits and couplings): distance of each pad from its goal over 1 mm; difference of
              pad directions over 0.2 if they were measured, else over 0.7; measured directions of
              last phalanges over 0.7; depth of links inside object, table and each other over 1 mm;
              direction to the palm over 0.5; deviation from the standard grasp's joints over two of
              their ranges. Pads thus have priority, and the standard grasp determines what they
              leave open
    opening   joints alone: pads as far from their contacts as the person's at the widest opening,
              clear of object and table
    target    on the line from the opening through the contact, until every pad is kPlacementOffset
              behind the surface; then the squeeze by statics (CalcSqueeze,
              core/develop/propose_grasps.h). Opening and target are then shifted, within limits, so
              that the closing hand passes through the contact. If that opening collides, the target
              instead continues straight from the original opening by the same amount, and if that
              collides, too, from the opening of the standard grasp

The person's hand is scaled by the object: contacts stay at their positions on it. A pad farther
than kReachedMiss from its goal is unreachable, and its digit leaves the grasp. Without two digits,
including the opposing one, the grasp is not transferable. Proposed by graspbench. Virtual fingers:
Arbib, Iberall and Lyons 1985.

Frames: O is the object's, at rest on the table with its axes parallel to W's.

Not modelled: forces, rolling of pads, skin. A marker represents the nearest point of the
surface. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kReachedMiss = 0.005;   ///< pads farther from their goal are unreachable
                                                ///< [m]
inline constexpr double kPadShare = 0.4;        ///< position on the last phalanx, from tip to pad
inline constexpr double kFarthestPad = 0.03;    ///< largest distance of bone and surface [m]
inline constexpr double kPadTolerance = 0.002;  ///< within this a pad matches the person's [m]

/** One digit of a person. Positions are markers or landmarks: the pad's goal is the nearest point
of the surface. */
struct PersonDigit {
  std::string digit;                              ///< "TH", "FF", "MF", "RF", "LF"
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  ///< position at contact [m]
  /** From there to its position at the widest opening, in the hand's own frame [m]. */
  Eigen::Vector3d opening_O = Eigen::Vector3d::Zero();
  /** Unit outward normal of the pad; zero: not measured, the inward surface normal is used. */
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();
  /** Unit, along the last phalanx to its tip; zero: not measured. */
  Eigen::Vector3d axis_O = Eigen::Vector3d::Zero();
  /** Landmarks of its joints, from the palm outwards; p_O is then the tip. Empty: one marker. */
  std::vector<Eigen::Vector3d> p_OJoints = {};
};

/** The reach before a grasp. */
struct PersonReach {
  double period = 0.02;      ///< between instants [s]
  double from_widest = 0.0;  ///< time from the widest opening to contact [s]
  /** Positions of the digits' markers at contact, then every period before, in O [m]: by instant,
  in the order of the digits. Fewer than two instants: not recorded. */
  std::vector<std::vector<Eigen::Vector3d>> p_OTips;
};

struct PersonGrasp {
  std::vector<PersonDigit> digits;  ///< those that touched, thumb first, then radial to ulnar
  /** Palm at contact: the mean of wrist and knuckles, otherwise a wrist marker [m]. */
  std::optional<Eigen::Vector3d> p_OPalm;
  /** Unit direction of the hand's motion towards the object; zero: unknown. */
  Eigen::Vector3d approach_O = Eigen::Vector3d::Zero();
  PersonReach reach = {};
};

/** From the thumb to the mean of the fingers. @param p_OTips  two or more, the thumb first. */
Eigen::Vector3d CalcOpeningAxis(const std::vector<Eigen::Vector3d>& p_OTips);

/** Displacements of the digits from their positions at contact, in the hand's own frame. Positions
are moved as a rigid hand: the opening axis (thumb to the mean of the fingers) is rotated by the
smallest rotation to that at contact, and its midpoint shifted to that at contact.
@pre as many positions as at contact, two or more, the thumb first. */
std::vector<Eigen::Vector3d> CalcDigitOpenings(const std::vector<Eigen::Vector3d>& p_OTips,
                                               const std::vector<Eigen::Vector3d>& p_OContact);

/** Sets opening_O by CalcDigitOpenings from the positions at the widest opening. */
void SetOpening(const std::vector<Eigen::Vector3d>& p_OOpen, PersonGrasp& person);

/** Derives pads from the landmarks of the joints. The pad is kPadShare of the last phalanx before
the tip. It faces perpendicular to the phalanx, in the plane in which the digit bends; that of a
straight digit faces the surface as far as possible. It touches the surface where that direction
meets it, within kFarthestPad, otherwise at the nearest point. Digits without landmarks are
unchanged. @pre FindPersonFault is empty. */
PersonGrasp UseLandmarks(const PersonGrasp& person, const GraspObject& object);

/** Why a recorded grasp cannot be that of a person on this object; empty: it can. Reasons are too
few digits, a digit far from the surface (wrong unit, object pose missing or of another trial),
exchanged digits, or joints of another digit. */
std::string FindPersonFault(const PersonGrasp& person, const GraspObject& object);

/** +1: a left hand, -1: a right hand, 0: unknown. It is determined by the position of the palm
behind the thumb and two fingers. */
int FindHandedness(const PersonGrasp& person);
int FindHandedness(const Hand& hand, const Grasp& standard);

/** Goal of one digit of the hand. */
struct PadGoal {
  int digit = -1;                                    ///< index into Hand::digits
  std::string person;                                ///< digits that it represents: "RF",
                                                     ///< "MF+RF+LF"
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();     ///< on the surface [m]
  Eigen::Vector3d nhat_O = Eigen::Vector3d::Zero();  ///< unit outward normal of the pad
  bool is_direction_measured = false;
  Eigen::Vector3d axis_O = Eigen::Vector3d::Zero();  ///< unit, that of the person; zero: any
  Eigen::Vector3d opening_O = Eigen::Vector3d::Zero();
};
/** @param reverse  assign the hand's fingers in reverse order, for a hand with two fingers that may
exchange their roles. @pre FindPersonFault is empty; the object has its distance field. */
std::vector<PadGoal> PairDigits(const Hand& hand, const PersonGrasp& person,
                                const GraspObject& object, bool reverse = false);

/** Deviation of a pad from the person's. */
struct PadMiss {
  std::string digit, person;
  double distance = 0.0;  ///< [m]
  double angle = 0.0;     ///< between the directions [rad]
  bool is_reached() const { return distance <= kReachedMiss; }
};

struct TransferredGrasp {
  std::string not_transferable;  ///< the reason; empty: it is transferable
  Grasp grasp;                   ///< with placement, for this object only
  std::string standard;          ///< id of the standard grasp used as reference
  Eigen::VectorXd q_contact;     ///< (num_joints)
  /** Deviations at contact, followed by those of digits that left the grasp. */
  std::vector<PadMiss> pads;
  double room = 0.0;  ///< least gap of the open digits and the object over all draws [m]
  /** Names of the grasp's joints that pads and measured directions do not determine. */
  std::vector<std::string> undetermined;
};

/** @param standard  the hand's standard grasps. @pre the object has its distance field. */
TransferredGrasp TransferGrasp(const Hand& hand, const std::vector<Grasp>& standard,
                               const PersonGrasp& person, const GraspObject& object);

}  // namespace graspbench
