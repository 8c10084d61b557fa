#pragma once
/** @file
Condition means with error bars, and differences of all pairs of conditions.

The kinds of error bars in a within-person design answer different questions; a figure must name its
kind:
- between-person: mean of one condition in the population, t s_j / sqrt(n). Not informative about
  differences between conditions.
- Loftus and Masson (Psychon. Bull. Rev. 1 (1994)): t sqrt(MS_error / n) with the pooled
  person x condition error, (n - 1)(C - 1) degrees of freedom. One length for all; needs sphericity.
- Cousineau (Tutor. Quant. Methods Psychol. 1 (2005)): between-person bars after subtracting each
  person's own mean. Too short by sqrt((C - 1) / C).
- Cousineau-Morey (Morey, Tutor. Quant. Methods Psychol. 4 (2008)): the same, with this corrected.
Franz and Loftus (Psychon. Bull. Rev. 19 (2012)) show that the last two hide violated sphericity and
propose the intervals of all pairwise differences instead: ComparePairs. */

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "human_study/statistics/location_tests.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

enum class BarKind { kBetweenPerson, kLoftusMasson, kCousineau, kCousineauMorey };

/** All kinds, in the order above. */
const std::vector<BarKind>& ListBarKinds();

/** For the caption: "95 % interval of the mean between persons" and the like. */
std::string_view NameOf(BarKind kind);

/** Computes half the length of each condition's 95 % bar. No answer below two persons, or for
within-person bars of a single cell. */
Answer<Eigen::VectorXd> CalcHalfWidths(const CellMeans& cells, BarKind kind);

struct PairComparison {
  size_t a = 0, b = 0;  ///< conditions, a < b
  Answer<TTest> test;   ///< of b - a
  double p_holm = 1.0;  ///< over all pairs; NaN without a test
};

/** Compares all pairs of conditions, in order. */
std::vector<PairComparison> ComparePairs(const CellMeans& cells);

/** Two levels of a between-person factor: b - a in the persons' means over all conditions. */
struct GroupComparison {
  size_t group = 0;     ///< index of the factor
  size_t a = 0, b = 0;  ///< its levels, a < b
  Answer<WelchTest> test;
  double p_holm = 1.0;  ///< over all pairs of all such factors; NaN without a test
};

std::vector<GroupComparison> CompareGroups(const CellMeans& cells);

}  // namespace graspbench
