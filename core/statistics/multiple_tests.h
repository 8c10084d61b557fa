#pragma once
/** @file
Adjusted p values of several tests; compare them with the desired level.

Holm controls the probability of any false finding (S. Holm, Scand. J. Stat. 6 (1979)):

    p'_(i) = max over j <= i of min(1, (m - j + 1) p_(j))

Benjamini and Hochberg control the expected share of false findings among all findings, if the tests
are independent or positively dependent (J. R. Stat. Soc. B 57 (1995)):

    p'_(i) = min over j >= i of min(1, m p_(j) / j) */

#include <vector>

namespace graspbench {

/** Returns the adjusted values in the order of the input. NaN marks a test that was not performed:
it stays NaN and does not count. @pre all other values are within [0, 1]. */
std::vector<double> AdjustHolm(const std::vector<double>& p);

/** As AdjustHolm, for the false discovery rate. */
std::vector<double> AdjustBenjaminiHochberg(const std::vector<double>& p);

}  // namespace graspbench
