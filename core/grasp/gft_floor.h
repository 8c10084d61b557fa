#pragma once
/** @file
How simultaneous contacts could be if only scatter were left: what remains of GFT% when a pre-grasp
lets every digit come at the same time on average.

With t_ik the first contact of digit i in trial k, m_i the median of t_ik over the trials in which
the digit touched, and M = max m_i, each digit's times are shifted by its own median, to that of the
last digit:

    t'_ik = t_ik - m_i + M
    floor = median over k of GFT%(t'_1k, t'_2k, ..)      (contact_timing.h)

So no digit is hurried, earlier ones wait, and what is left is how they scatter from trial to trial,
because the object's place and the joints vary. It is an oracle: it knows the medians of the very
trials it is shown for. Digits that are late by constants have a floor of 0. A trial in which a
digit never touched counts as infinite, as no shift makes it touch. Medians are not the shifts with
the smallest median ratio, so GFT% may lie a little below its floor. Proposed by graspbench. */

#include <vector>

#include "core/grasp/contact_timing.h"
#include "core/statistics/answer.h"

namespace graspbench {

/** The floor is not known from fewer trials in which all digits touched. */
inline constexpr int kLeastTrialsOfFloor = 5;
/** GFT% of at most so many floors: hardly anything but scatter is left. */
inline constexpr double kNearGftFloor = 1.2;

/** m_i of each digit [s]; NaN for one that never touched.
@param trials  the contacts of each, of the same digits in the same order; empty: it gave up. */
std::vector<double> CalcMedianTimes(const std::vector<std::vector<DigitContact>>& trials);

/** As a ratio.
@param trials  the contacts of each, of the same digits in the same order; empty: it gave up.
@param t0  start of closure [s].
@returns no answer where fewer than two digits ever touched, all touched in fewer than five trials,
or half of the trials or more lack a contact. */
Answer<double> CalcGftFloor(const std::vector<std::vector<DigitContact>>& trials, double t0 = 0.0);

}  // namespace graspbench
