#pragma once
/** @file
Properties of a hand that a URDF does not state, inferred from its tree and its shapes; hand.yaml
marks them as guesses.

- A digit is a chain of links from the palm outwards to an end that can touch, starting after the
  last link that it shares with another chain. A chain is part of a neighbour's linkage if it only
  follows other joints, or leads the neighbour's, and reaches less far than the neighbour.
- The pad faces the direction in which the last link moves when the digit closes
  (core/hand/closing.h).
- The thumb is the digit of that name, otherwise the one that faces the others most.
- The palm faces the point where the digits can meet (FindMeeting). If the fingers' pads face within
  60 degrees of that direction, their common direction is used, which is more exact. The direction
  of a gripper is snapped to an axis within 37 degrees. Digits that cannot meet in front of the palm
  are an error. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/hand.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Sets digits, the palm's frame and surface, drives and accuracies, and places the root so that
the palm's frame is H. @param file  name of the description in messages.
@param palm_normal  normal out of the palm, in its frame; nullopt: guessed. */
void GuessHand(const std::string& file, const std::optional<Eigen::Vector3d>& palm_normal,
               ImportedHand& imported, Diagnostics& problems);

/** Determines the normal and the centre of the palm's surface of an imported hand.

The normal is guessed from the directions of the pads when the digits are open, and from the point
where the digits meet (FindMeeting). Digits that close away from the others (FindOutwardDigits) and
digits whose limits do not determine a closing direction are ignored. An error that asks for
--palm-normal results if no digit determines the normal, if no digit approaches the thumb, or if
they meet more than 20 mm behind the palm's surface. From 10 mm on this is reported. A given normal
is always used; if it is more than 60 degrees from the guess, this is reported.

@param given  normal in the palm's frame. @param facing  by digit: direction of its pad in H, with
the digits open; 0: unknown. @pre the digits have tips and pads, and one of them is the thumb. */
void GuessPalm(const std::string& file, const std::optional<Eigen::Vector3d>& given,
               const std::vector<Eigen::Vector3d>& facing, ImportedHand& imported,
               Diagnostics& problems);

/** Where the digits of a hand can meet, and hence which way its palm faces.

The thumb and each other digit are closed independently, each by a share of its range. They meet
where their pads come nearest, if this is at most half of their open distance or 25 mm. If closing
alone does not bring a pair together, all joints of the pair are searched. The palm faces from the
centre of the digits' bases to the centre of the meeting points. */
struct DigitMeeting {
  Eigen::Vector3d p_H = Eigen::Vector3d::Zero();  ///< mean of the pairs' meeting points [m]
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero();  ///< from the centre of the bases to p_H; unit, or 0
  double gap = 0.0;             ///< least distance of two pads [m]
};

/** Returns nullopt if no pair meets. @param left_out  by digit: it is ignored; the thumb never is.
@param is_first  choose, of the postures within 10 mm of the pair's least distance, the least
closed.
@pre digits with tips and pads, one of them the thumb. */
std::optional<DigitMeeting> FindMeeting(const Hand& hand, const std::vector<bool>& left_out,
                                        bool is_first = false);

/** Posture number `number` of an even sequence (Kronecker) over the ranges of all joints of two
digits; other joints stay as in `open`. @param number  counted from 1. */
Eigen::VectorXd MakePairSample(const Hand& hand, const Eigen::VectorXd& open, const Digit& a,
                               const Digit& b, int number);

/** Sets the drives of an imported hand: published values where they suit a finger's drive,
otherwise a guess.

An effort is rejected if more than three drives have the same 10, 100 or 1000, which exporters write
as a placeholder. It is also rejected if it exceeds 100 N at the tip of the longest digit (250 N for
a gripper), or, for a slide, 1 kN per kilogram of the hand. Stiffness and damping of a position
drive are used if they hold a finger without letting it oscillate or creep. Rejected values are
reported, and so is an effort that bears less than half of the weight that its joint moves.

@pre the digits are known. */
void GuessDrives(const std::string& file, ImportedHand& imported, Diagnostics& problems);

/** Names of the digits of a foreign hand: by the names of their links and joints, then by position.

Gives each digit the id ("TH", "FF", ..) that most names of its links and joints suggest. If two
digits share an id, the one with more such names keeps it, and neither if they are equal, since
"middle" may denote a phalanx. The other digits get none. */
void NameByVotes(Hand& hand);

/** Names the remaining digits from the thumb's side, FF, MF, RF, LF, D1, .., and sorts all in the
order of a hand, the thumb last. @pre one digit is the thumb, and the tips are known. */
void NameDigits(Hand& hand);

}  // namespace graspbench
