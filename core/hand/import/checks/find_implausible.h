#pragma once
/** @file
What an imported hand has that the reader can read but no hand has: what the searches below find;
jaws that run the same way; a joint that moves by less than a degree or half a millimetre or by more
than 3.6 rad, or follows a joint of another digit behind one with a drive of its own; a longest
digit longer than 250 mm, or shorter than 30 mm without published masses that fit, less than
10 g in all, less than 200 or more than 12,000 kg by cubic
metre of its shapes, a palm of more than 50 times the mass of all digits. Reported, not changed: who
made the description knows what was meant. */

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/hand.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FindImplausible(const std::string& file, const ImportedHand& imported, Diagnostics& problems);

/** Whether digits can hold something between them: pads that face each other, near enough, with no
palm between.

By digit: it opposes another one. Over postures that close both to any share, and others that
move all their joints, the line between the two pads leaves each by 70 degrees from its normal at
most, is free of the palm, and is 40 mm long at most, or half as long as at the open hand; or their
last links come together by closing. Fingers side by side that bend the same way oppose no other of
them. A digit without shapes has no pad that faces anywhere, and is not doubted.
@pre digits with tips and pads. */
std::vector<bool> FindOpposedDigits(const ImportedHand& imported);

/** Digits that close away from all others: their axes or limits are reversed, or they grasp from
within.

By digit. While the others stand open, or closed by a quarter, all of the digit's joints close to
0.4 of their ranges. If its pad recedes from one of theirs and comes nearer to none by a fifth of
that, or 1 mm, it closes outward. @pre digits with tips and pads. */
std::vector<bool> FindOutwardDigits(const Hand& hand);

/** Digits of one build that are not described alike. Of fingers side by side and of copies about a
hub an axis is the mirror image of the others'. Of three in a row one differs from two that agree:
its axis by more than 37 degrees; it stands 30 mm off their row; a joint turns or lies 1.8 times as
far, has a fifth of their effort or five times as much, follows another by a third or three times as
much; a link is 1.8 times as long or three times as heavy. Of three copies, wherever they stand, one
joint turns about another axis of its frame. And of a digit that bends by three joints or more one
bends the other way. Reported by the name of the joint or link.

@returns the joints whose axes were told. @pre the digits are known. */
std::set<int> FindUnlikeDigits(const std::string& file, const ImportedHand& imported,
                               Diagnostics& problems);

/** Links that stand where none can: at the open hand one link of a digit within another digit, deep
in the palm or back in its own digit, or in the air, apart from the link that carries it; collision
shapes beside the picture of their link, or of another size. Reported by name, with the distance:
the place of a joint or of a shape is wrong. What lies near a digit's first joint may be within the
palm, its housing.

@pre the digits are known. */
void FindMisplacedLinks(const std::string& file, const ImportedHand& imported,
                        Diagnostics& problems);

/** Digits as rows of joints, to compare those that stand side by side. A digit's joints that bend
it, from base to tip, and how it stands at the open hand. In H. */
struct DigitRow {
  const Digit* digit = nullptr;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();   ///< of its first joint [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< from there to its tip; unit, or 0
  std::vector<int> joints;
  std::vector<Eigen::Vector3d> turns;  ///< about which these close
  std::vector<Eigen::Vector3d> axes;   ///< by link of the digit, as described
};
std::vector<DigitRow> MakeDigitRows(const Hand& hand);

/** Fingers that stand in a row, along the axes about which they bend, with as many links: what is
built alike must be described alike. Half of their axes at least have that direction. */
bool AreSideBySide(const DigitRow& a, const DigitRow& b);

/** The digit stands in the row of two others that are side by side and bend the same way: parallel
to them, with as many links, whichever way it bends. @param off_line  of its base from the line
through theirs, at most [m]. */
bool IsInRowOf(const DigitRow& digit, const DigitRow& a, const DigitRow& b, double off_line);

/** From the base to the tip, at the open hand [m]. */
double CalcLongestDigit(const Hand& hand);

}  // namespace graspbench
