#pragma once
/** @file
Repeated-measures analysis of variance: every person is in every cell of any number of factors
within persons, and in one group of each factor between persons.

Each effect involves a set of factors. Those within persons yield d orthonormal contrasts of the
cells: the Kronecker product of the Helmert contrasts of these factors and of the means over all
others. The persons' contrast scores are Z (persons x d). Factors between persons yield columns of
the design X (persons x q, effect coded, full factorial). With B = (X^T X)^-1 X^T Z and J the
columns of the effect (the constant, for a purely within-person effect)

    SS_effect = tr B_J^T ([(X^T X)^-1]_JJ)^-1 B_J,   SS_error = tr E,  E = |Z - X B|^2
    F = (SS_effect / (d |J|)) / (SS_error / (d (n - q)))

which are type III sums of squares: groups of different size have equal weight. Without groups, X is
a column of ones and SS_effect = n |zbar|^2.

The F distribution assumes sphericity (S = E / (n - q) proportional to the identity):
- Mauchly: W = det S / (tr S / d)^d, p by Box's expansion to second order (T. W. Anderson, "An
  introduction to multivariate statistical analysis", 3rd ed. 2003, section 10.7.4). One term uses
  the number of cells where Anderson uses d, as R and its package car do, so that readers can
  reproduce the figure. For 8 persons and W = 0.0327 the exact p is 0.00180, R's 0.00178,
  Anderson's 0.00177;
- Greenhouse-Geisser: epsilon = (tr S)^2 / (d tr S^2) (Psychometrika 24 (1959));
- Huynh-Feldt: ((n - q + 1) d epsilon - 2) / (d (n - q - d epsilon)) (J. Educ. Stat. 1 (1976), in
  the form of afex and car for groups), at most 1.
A corrected test multiplies both degrees of freedom by epsilon.

Effect sizes: partial eta squared SS_effect / (SS_effect + SS_error); generalised eta squared
SS_effect / (SS_effect + SS_person + sum of all SS_error), every factor being manipulated (Olejnik
and Algina, Psychol. Methods 8 (2003); Bakeman, Behav. Res. Methods 37 (2005)). For observed groups,
which are not manipulated, generalised eta squared is too large.

Not modelled: covariates, missing cells (measure_table.h leaves such a person out and reports it;
effects_model.h includes them). */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

struct MauchlyTest {
  double w = 1.0;
  double p = 1.0;
};

struct CorrectedF {
  double epsilon = 1.0;
  double df_effect = 0.0;
  double df_error = 0.0;
  double p = 1.0;
};

struct WithinTest {
  double f = 0.0;
  double p = 1.0;  ///< uncorrected
  CorrectedF greenhouse_geisser;
  Answer<CorrectedF> huynh_feldt;  ///< none when it is undefined, for too few persons
  Answer<MauchlyTest> mauchly;     ///< none for one contrast, or fewer persons than contrasts + 1
  double partial_eta_squared = 0.0;
  double generalised_eta_squared = 0.0;
};

struct WithinEffect {
  std::string name;             ///< "object", "object x condition"
  std::vector<size_t> factors;  ///< indices of its factors within persons
  std::vector<size_t> groups;   ///< indices of its factors between persons
  double ss_effect = 0.0;
  double ss_error = 0.0;
  double df_effect = 0.0;
  double df_error = 0.0;
  Answer<WithinTest> test;  ///< none when persons do not differ in this effect
};

struct WithinAnova {
  int num_persons = 0;
  double ss_person = 0.0;             ///< between persons within groups
  std::vector<WithinEffect> effects;  ///< main effects, within persons first, then pairs, ..
};

/** No answer for a single person, a factor with one level, more than 8 factors, or a group (or a
combination of groups) with fewer than two persons, whose variance is unknown. */
Answer<WithinAnova> CalcWithinAnova(const CellMeans& cells);

/** Computes Huynh and Feldt's epsilon, at most 1, from Greenhouse and Geisser's. No answer unless
num_persons - 1 > num_contrasts * epsilon. */
Answer<double> CalcHuynhFeldt(double greenhouse_geisser, int num_contrasts, int num_persons);

/** Computes the p value of Mauchly's W. @pre 0 < w <= 1, num_contrasts >= 2, num_persons >
num_contrasts. */
double CalcMauchlyP(double w, int num_contrasts, int num_cells, int num_persons);

/** One-way analysis of variance of groups of values, possibly of different size: the variation
between groups (persons) relative to that of values (trials) within groups.

    F = (SS_between / (g - 1)) / (SS_within / (N - g)) */
struct OneWayAnova {
  int num_groups = 0;
  int num_values = 0;
  double ss_between = 0.0;
  double ss_within = 0.0;
  double df_between = 0.0;
  double df_within = 0.0;
  double ms_between = 0.0;
  double ms_within = 0.0;  ///< > 0
  double f = 0.0;
  double p = 1.0;
};

/** Empty groups are ignored. No answer below two groups, when no group has two values, when no
group has any spread, or with a value that is not finite. */
Answer<OneWayAnova> CalcOneWayAnova(const std::vector<std::vector<double>>& groups);

/** As CalcOneWayAnova without p, which stays 1; faster, for thousands of calls. */
Answer<OneWayAnova> CalcMeanSquares(const std::vector<std::vector<double>>& groups);

}  // namespace graspbench
