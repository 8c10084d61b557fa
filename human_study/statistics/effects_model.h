#pragma once
/** @file
Mixed model (reml.h) of all trials of a measure under all factors, within and between persons:

    y = mean + factors, groups and all their interactions
          + the person's own level and own effect of each factor + the session's + e

In lme4's notation y ~ A * B * G + (A + B | person) + (1 | person:session), with sum-to-zero coding
of factors and a centred linear term for a quantity. Persons with empty conditions or unequal
numbers of trials are included. Effects are tested jointly (type III) with Satterthwaite's degrees
of freedom.

The random part is the fullest that the data support on this ladder; `fallbacks` lists the parts
dropped, and why:
1. the person's level and effects with all correlations, and the session's level;
2. the person's level, and for each factor one variance of the person's deviations at its levels,
   lme4's (1 | person) + (1 | person:A) + (1 | person:B), which does not depend on the coding of A;
   for a quantity the person's level at its mean and the person's slope, uncorrelated;
3. rung 2 without the parts whose variance is zero, until none is zero.
If no part remains, persons are indistinguishable, and there is no answer. An effect without
variance between persons is tested against the trials: its p is too small if it does vary.

Not modelled: interactions by person, groupings that cross persons (objects as a sample of objects),
covariates. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/statistics/measure_table.h"
#include "human_study/statistics/reml.h"

namespace graspbench {

/** A t test of one number that the model estimates. */
struct CoefficientTest {
  double df = 0.0;  ///< Satterthwaite's
  double p = 1.0;
  Interval interval;  ///< 95 %
};

/** Slope over a quantity, for all persons and groups together. */
struct SlopeEstimate {
  double estimate = 0.0;  ///< per unit of the quantity
  double standard_error = 0.0;
  double reference = 0.0;  ///< value under the null hypothesis
  double t = 0.0;
  Answer<CoefficientTest> test = NoAnswer{"not calculated"};
};

struct EffectTest {
  std::string name;  ///< "object", "object x group"
  Answer<RemlFTest> test;
};

/** Model-based mean of a condition, with equal weights for persons and groups. */
struct CellEstimate {
  std::string cell;
  double estimate = 0.0;
  double standard_error = 0.0;
  Answer<CoefficientTest> test;  ///< only its interval is of interest
};

/** A part of the random effects and its standard deviation. */
struct RandomPart {
  std::string name;  ///< "level of persons", "object: cup", "persons x object", ..
  double sd = 0.0;   ///< for a slope: per unit of the quantity
};

struct EffectsModel {
  int num_persons = 0;
  int num_observations = 0;
  bool is_correlated = false;  ///< between the persons' level and effects
  std::vector<std::string> fallbacks;
  std::vector<EffectTest> effects;  ///< main effects, within persons first, then pairs, ..
  std::vector<CellEstimate> cells;  ///< as ListCells(); none for a quantity
  Answer<SlopeEstimate> slope = NoAnswer{"no quantity"};
  std::vector<RandomPart> random;  ///< of the rung used
  double residual_sd = 0.0;
  double reml_criterion = 0.0;
};

/** Fits all factors by their levels. No answer for one level or one person, a group with one
person, a combination of levels without a trial, or when no rung of the ladder can be fitted. */
Answer<EffectsModel> FitEffectsModel(const MeasureTable& table);

/** Fits one factor as a quantity, with all groups: tests its slope against `reference`, and whether
the slope differs between groups. No answer as above, and when the factor has no numbers.
@pre factor < table.factors.size(). */
Answer<EffectsModel> FitQuantityModel(const MeasureTable& table, size_t factor,
                                      double reference = 0.0);

/** Describes the variation between persons and sessions, for notes. */
std::string DescribeRandom(const EffectsModel& model);

}  // namespace graspbench
