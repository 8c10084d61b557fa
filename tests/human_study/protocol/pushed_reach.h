#pragma once
/** @file
Reaches for an object that the first digit pushes before the others arrive: a fourth generator,
written from mechanics alone, without knowledge of human_study/events and human_study/study.

A rigid upright cylinder of mass m slides on a table with Coulomb friction mu m g. The tip of a digit
is a small mass on a spring and a damper that pull it along its plan (impedance control, Hogan 1985);
the plan is two overlapping minimum-jerk strokes (Flash & Henis 1991), to a place beside the object
and from there onto it. Skin and surface meet as a stiff unilateral spring with friction. Once a
digit feels the object its plan slows down within some millimetres: the first digit's by as much
further as the object is to be pushed. When all digits have arrived they grip in balance, then lift.
Nobody prescribes the object's way: it follows from the forces. The truth is the step of the
integration (0.1 ms) in which skin and surface first meet. World frame W: z up, the table at z = 0.

A soft pad resists exponentially (Pawluk & Howe 1999): about 0.9 mm at 0.5 N with a pad_depth of
0.5 mm, and it sinks in again when the grip is built up.

Conditions that count: rate, noise_sd, num_object_markers, distances, digit_sd, touch speeds, push
(0: the object is too heavy to slide), pad_depth, is_object_left_behind. SI units. */

#include "tests/human_study/protocol/everyday_reach.h"

namespace graspbench::everyday {

/** A pure function of conditions, id (of a person) and trial (from 0). */
Reach MakePushedReach(const Conditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::everyday
