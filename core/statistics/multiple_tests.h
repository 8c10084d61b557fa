#pragma once
/** @file
p values of several tests at once, adjusted; compare them with the level wanted.

Holm keeps the chance of any false finding (S. Holm, Scand. J. Stat. 6 (1979)):

    p'_(i) = max over j <= i of min(1, (m - j + 1) p_(j))

Benjamini and Hochberg keep the expected share of false findings among all findings, where the tests
do not depend on each other or depend positively (J. R. Stat. Soc. B 57 (1995)):

    p'_(i) = min over j >= i of min(1, m p_(j) / j) */

#include <vector>

namespace graspbench {

/** In the order of the input. NaN is a test that was not made: it stays NaN and does not count.
@pre the rest lies within [0, 1]. */
std::vector<double> AdjustHolm(const std::vector<double>& p);

/** As AdjustHolm, for the false discovery rate. */
std::vector<double> AdjustBenjaminiHochberg(const std::vector<double>& p);

}  // namespace graspbench
