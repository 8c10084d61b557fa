#pragma once
/** @file
What a URDF does not say about a hand, guessed from its tree and its shapes; hand.yaml tells the
user that they are guesses.

- A digit is a chain of links from the palm outwards to an end that can touch, from the last link
  that it shares with another chain. A chain that only follows other joints, or leads the
  neighbour's, and reaches less far than that neighbour is part of its linkage.
- The pad faces where the last link goes when the digit closes (core/hand/closing.h).
- The thumb is the digit of that name, otherwise the one that faces the others most.
- The palm faces where the digits can meet (FindMeeting). Where the fingers' pads face the same
  way, within 60 degrees of that, they say it more exactly; an axis that is within 37 degrees of
  the direction of a gripper is meant. Digits that cannot meet in front of the palm are an error. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/hand.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Fills digits, the palm's frame and its surface, the drives and the accuracies; puts the root
where the palm's frame is H. @param file  of the description, for messages.
@param palm_normal  out of the palm, in its frame; nothing: guessed. */
void GuessHand(const std::string& file, const std::optional<Eigen::Vector3d>& palm_normal,
               ImportedHand& imported, Diagnostics& problems);

/** Which way the palm of an imported hand faces, and the middle of its surface.

The normal is guessed from where the pads of the open digits face and from where the digits meet
(FindMeeting). Digits that close away from the others (FindOutwardDigits), and those whose limits
do not say to which side they close, tell nothing of it. It is an error, which asks for
--palm-normal, when no digit tells it, when no digit approaches the thumb, or when they meet more
than 20 mm behind the palm's surface; from 10 mm on it is reported. A normal that is given is taken;
one more than 60 degrees from the guess is reported.

@param given  in the palm's frame. @param facing  by digit: of its pad in H, at the open hand; 0:
not known. @pre the digits have tips and pads, one of them is the thumb. */
void GuessPalm(const std::string& file, const std::optional<Eigen::Vector3d>& given,
               const std::vector<Eigen::Vector3d>& facing, ImportedHand& imported,
               Diagnostics& problems);

/** Where the digits of a hand can meet, and so which way its palm faces.

Each pair of the thumb and another digit closes, each digit by its own share of its range; where
the pads come nearest to each other, at half their open distance or less, they meet. When closing
alone brings no pair together, all joints of the pair are searched. The palm faces from the middle
of the digits' bases to the middle of the meeting points. */
struct DigitMeeting {
  Eigen::Vector3d p_H = Eigen::Vector3d::Zero();  ///< mean of where pairs meet [m]
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero();  ///< from the digits' bases to it; unit, or 0
  double gap = 0.0;             ///< of the pads that come nearest [m]
};

/** Nothing: no pair meets. @param left_out  by digit: it is not asked; the thumb always is.
@param is_first  of the postures in which a pair comes as near, within 10 mm, that of least closing.
@pre digits with tips and pads, one of them the thumb. */
std::optional<DigitMeeting> FindMeeting(const Hand& hand, const std::vector<bool>& left_out,
                                        bool is_first = false);

/** Postures that move all joints of two digits, evenly spread (Kronecker sequence); the others stay
as in `open`. @param number  from 1. */
Eigen::VectorXd MakePairSample(const Hand& hand, const Eigen::VectorXd& open, const Digit& a,
                               const Digit& b, int number);

/** The drives of an imported hand: what is published where a finger's drive can have it, else a
guess.

An effort is taken unless more than three drives have the same 10, 100 or 1000, as exporters write
it where nobody knows, or it is more than 100 N at the tip of the longest digit, of a gripper 250
N, or of a slide more than 1 kN for each kilogram of the hand. Stiffness and damping of a position
drive are taken where they hold a finger without letting it swing or crawl. What is not taken is
reported, and so is an effort that does not bear half of the weight of what its joint moves.

@pre the digits are known. */
void GuessDrives(const std::string& file, ImportedHand& imported, Diagnostics& problems);

/** What the digits of a foreign hand are called: by the names of their links and joints, then
by their place.

Gives each digit the id ("TH", "FF", ..) that most names of its links and joints tell; of two
digits the one that tells it more often, and neither when they are equal: "middle" may be a phalanx.
The others have none. */
void NameByVotes(Hand& hand);

/** Names the others from the thumb's side, FF, MF, RF, LF, D1, .., and puts all in the order of a
hand, the thumb last. @pre one digit is the thumb; tips are placed. */
void NameDigits(Hand& hand);

}  // namespace graspbench
