#pragma once
/** @file
Limits of foreign joints and the unit of their lengths, repaired where they are implausible. */

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

struct StatedLimits {
  std::string missing;              ///< name of the missing part, "range"; empty: all stated
  double lower = 0.0, upper = 0.0;  ///< [rad], [m]
};

/** Sets the limits of a joint; reversed ones are exchanged. Missing or equal limits and those
beyond one turn set `no_limits`. Missing ones are provisionally half a turn each way, or 0 for a
slide.
@returns the repair, as text to follow the joint's name; empty: none. */
std::string SetLimits(const StatedLimits& stated, ForeignJoint& joint);

/** Handles joints without limits. A joint that follows another gets the range that the other's
limits imply. The others are fixed at zero, or at the one position that their limits allow. Each is
reported. Call this when all couplings are known. */
void FixUnlimited(const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Summary of the ranges of a description's hinges, as stated. */
struct StatedAngles {
  int num_joints = 0, num_beyond_turn = 0;
  int first_line = 0;
  double largest = 0.0;

  /** @param unit  unit in which the limits are read [rad]. */
  void Add(double lower, double upper, double unit, int line);
  /** Returns why the limits seem to be in the other unit; empty: they do not. Degrees that are all
  below 2 pi would let a finger move by a few degrees only. */
  std::string FindDoubt(bool in_degrees) const;
};

/** Repairs the stroke of a slide whose lengths are in metres. A missing one, or a limit beyond 1 m,
becomes 0 to 50 mm. @returns as SetLimits. */
std::string FinishStroke(ForeignJoint& joint);

/** Determines the unit of a description's lengths from the distances between its joints.

The joints of a finger are 20 to 60 mm apart. The typical distance in a description is the median of
those that are not zero. Its value, without a unit, decides:

    below 0.3       metres: the standard of the formats, and up to the links of an arm
    0.3 to 0.8      decimetres
    0.8 to 2.5      inches; the value in centimetres is reported, too
    2.5 to 9        centimetres; the value in inches is reported, too
    14 to 500       millimetres
    otherwise       unknown: an error that asks for --unit

The frame of a slide may lie anywhere along its axis, so its distance is not comparable. It counts
only above 2.5, which cannot be metres.

Converts positions, extents and strokes to metres and repairs strokes (FinishStroke). Meshes keep
their unit (load_shapes.h).
@param unit  of the description [m]; 0: inferred, and reported unless it is the metre. */
void SetLengthUnit(double unit, const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** By link: distance from its joint to the farthest joint on it [m]. For a link at the end of a
chain it is that of its own joint from the one before. Slides do not count. It is 0 if there is
none, as for a hub. */
std::vector<double> CalcLinkLengths(const ForeignHand& hand);

}  // namespace graspbench
