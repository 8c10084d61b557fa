#pragma once
/** @file
Reaches of a third generator, written from the protocol of everyday_reach.h alone and before its
author had read how human_study/ finds events and judges independence. It takes the same conditions
of a person (profiles, distances, ends, spreads, lags, drifts, speeds) and gives the same record of
the truth, but nothing moves on the same curve:

  * the hand accelerates and decelerates by half sines of unequal length, or by one large bell and a
    small correcting one that overlaps it (Meyer et al. 1988), by the person;
  * time follows the logarithm of the distance (Fitts 1954);
  * every person has own mean times of each digit; single trials scatter uniformly about them;
  * digits close on a raised cosine that aims beneath the surface and is stopped by it, beside a
    path that bows by some millimetres; the object is never put down twice at the same place.

A drift slows the whole hand from trial to trial, a random walk delays the digits alone. What
happens and what the laboratory does (pushes, regrasps, files) is not in here. World frame W: z up,
table at z = 0. SI units. */

#include "tests/human_study/protocol/everyday_reach.h"

namespace graspbench::everyday {

/** A pure function of conditions, id (of a person) and trial (from 0, as in the session). */
Reach MakeStrangerReach(const Conditions& conditions, const std::string& id, int trial);

}  // namespace graspbench::everyday
