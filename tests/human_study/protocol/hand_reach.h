#pragma once
/** @file
Reaches of a hand of bones: a fourth generator, made to ask which marker is the thumb's. Where the
other generators place each fingertip beside the object by itself, here a wrist, four fingers of
three phalanges and a thumb carry them, so that a tip is where anatomy lets it be.

Lengths of bones are the means of Buryanov and Kotiuk 2010 (Int. J. Morphol. 28(3):755-758), scaled
by the person (0.9 to 1.1) and the thumb once more (0.88 to 1.12); the wrist's marker is on its back
or at either side; every second person grasps with the left hand. A finger bends about one axis, its
three joints in proportion; the thumb turns about its saddle joint. Objects are cylinders that lie
across the fingers, of 6, 20, 45 and 80 mm, in turn from trial to trial. World frame W: z up. SI
units. */

#include "tests/human_study/protocol/everyday_reach.h"

namespace graspbench::everyday {

/** All digits grasp. Of the conditions it takes rate, noise, the distance of the hand and whether
labels are exchanged. A pure function of its arguments. */
Reach MakeHandReach(const Conditions& conditions, const std::string& id, int trial);

/** Thumb and index pinch the same things; the other fingers are curled into the palm. */
Reach MakePinchReach(const Conditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::everyday
