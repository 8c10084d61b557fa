#pragma once
/** @file
Finds properties of an imported hand that a reader accepts but that no real hand has. Besides the
findings of the searches below these are:

- jaws that move in the same direction;
- a joint that moves by less than a degree or half a millimetre, or by more than 3.6 rad;
- a joint that follows one of another digit, behind a joint with its own drive;
- a longest digit above 250 mm, or below 30 mm without published masses that fit;
- a mass below 10 g, or a density of the shapes below 200 or above 12,000 kg/m^3;
- a palm of more than 50 times the mass of all digits.

They are reported but not changed, since only the author knows what was meant. */

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

/** Finds digits that can hold something between them: their pads face each other, near enough, with
no palm between.

Returns by digit whether it opposes another one. The search covers postures that close both digits
to any share, and others that move all their joints. In one of them the line between the two pads
must leave each at most 70 degrees from its normal and not cross the palm. It must be at most 40 mm
long, or half as long as at the open hand. Alternatively, the last links come together by closing.
Fingers side by side that bend the same way do not oppose each other. A digit without shapes has no
pad normal and counts as opposed. @pre digits with tips and pads. */
std::vector<bool> FindOpposedDigits(const ImportedHand& imported);

/** Finds digits that close away from all others: their axes or limits are reversed, or they grasp
from within.

Returns by digit whether it closes outward. All joints of the digit close to 0.4 of their ranges
while the others are open, or closed by a quarter. Its pad must recede from one of theirs and
approach none by 1 mm, or by a fifth of the recession. @pre digits with tips and pads. */
std::vector<bool> FindOutwardDigits(const Hand& hand);

/** Finds digits of the same construction that are not described alike, and reports the joint or
link. It reports:

- of fingers side by side, and of copies about a hub, an axis that mirrors those of the others;
- of three in a row, one that differs from two that agree: an axis by more than 37 degrees, a base
  30 mm off the row, a joint range or distance by a factor of 1.8, an effort by a factor of 5, a
  coupling ratio by a factor of 3, a link's length by 1.8 or mass by 3;
- of three copies, wherever they are, one joint that turns about another axis of its frame;
- of a digit that bends by three joints or more, one joint that bends the other way.

@returns the joints whose axes were reported. @pre the digits are known. */
std::set<int> FindUnlikeDigits(const std::string& file, const ImportedHand& imported,
                               Diagnostics& problems);

/** Finds links at impossible positions, with the hand open. A link lies within another digit, deep
in the palm or in its own digit, or hangs in the air, apart from the link that carries it. Collision
shapes may also lie beside the visual of their link, or differ from it in size. Each is reported by
name, with the distance: the position of a joint or of a shape is wrong. Links near a digit's first
joint may be inside the palm, its housing.

@pre the digits are known. */
void FindMisplacedLinks(const std::string& file, const ImportedHand& imported,
                        Diagnostics& problems);

/** A digit as a row of joints, to compare digits side by side: the joints that bend it, from base
to tip, and its pose at the open hand. In H. */
struct DigitRow {
  const Digit* digit = nullptr;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();   ///< position of its first joint [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit direction from base to tip, or 0
  std::vector<int> joints;
  std::vector<Eigen::Vector3d> turns;  ///< axes by joint, signed so that it closes
  std::vector<Eigen::Vector3d> axes;   ///< by link of the digit, as described
};
std::vector<DigitRow> MakeDigitRows(const Hand& hand);

/** Whether two fingers stand in a row along the axes about which they bend, with the same number of
links; they should then be described alike. At least half of their axes must have that direction. */
bool AreSideBySide(const DigitRow& a, const DigitRow& b);

/** Whether the digit stands in the row of two others that are side by side and bend the same way.
It must be parallel to them and have as many links, but may bend in any direction.
@param off_line  largest distance of its base from the line through theirs [m]. */
bool IsInRowOf(const DigitRow& digit, const DigitRow& a, const DigitRow& b, double off_line);

/** Largest distance from the base to the tip of a digit, at the open hand [m]. */
double CalcLongestDigit(const Hand& hand);

}  // namespace graspbench
