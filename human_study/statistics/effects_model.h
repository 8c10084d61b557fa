#pragma once
/** @file
All trials of a measure under all factors, within and between persons, as a mixed model (reml.h):

    y = mean + factors, groups and all that they do together
          + the person's own level and own effect of each factor + the session's + e

lme4's y ~ A * B * G + (A + B | person) + (1 | person:session), factors coded to sum to zero, a
quantity as a line about its mean. Persons with empty conditions and different numbers of trials stay
in. Effects are tested together (type III) with Satterthwaite's degrees of freedom.

The random part is the fullest that the data carry, down this ladder; what was left, and why, is in
`fallbacks`:
1. the person's level and effects with all their correlations, and the session's level;
2. the person's level, and for each factor one variance of the person's deviations at its levels,
   lme4's (1 | person) + (1 | person:A) + (1 | person:B), which does not hang on the coding of A;
   for a quantity the person's level at its mean and the person's slope, uncorrelated;
3. the same without each part whose variance is zero, until none is.
Where nothing is left persons cannot be told from each other, and there is no answer. An effect that
no longer varies between persons is tested against trials: its p is too small if it does vary.

Not modelled: persons' own interactions, groupings that cross persons (objects as a sample of
objects), covariates. */

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

/** Of a quantity, over persons and groups alike. */
struct SlopeEstimate {
  double estimate = 0.0;  ///< per unit of the quantity
  double standard_error = 0.0;
  double reference = 0.0;  ///< what it is tested against
  double t = 0.0;
  Answer<CoefficientTest> test = NoAnswer{"not calculated"};
};

struct EffectTest {
  std::string name;  ///< "object", "object x group"
  Answer<RemlFTest> test;
};

/** Mean of a condition as the model has it: every person and group weighs the same. */
struct CellEstimate {
  std::string cell;
  double estimate = 0.0;
  double standard_error = 0.0;
  Answer<CoefficientTest> test;  ///< its interval counts
};

/** A part of the random effects and its standard deviation. */
struct RandomPart {
  std::string name;  ///< "level of persons", "object: cup", "persons x object", ..
  double sd = 0.0;   ///< of a slope: per unit of the quantity
};

struct EffectsModel {
  int num_persons = 0;
  int num_observations = 0;
  bool is_correlated = false;  ///< the persons' level and effects
  std::vector<std::string> fallbacks;
  std::vector<EffectTest> effects;  ///< main effects, within persons first, then pairs, ..
  std::vector<CellEstimate> cells;  ///< as ListCells(); none for a quantity
  Answer<SlopeEstimate> slope = NoAnswer{"no quantity"};
  std::vector<RandomPart> random;  ///< of the rung it stands on
  double residual_sd = 0.0;
  double reml_criterion = 0.0;
};

/** All factors by their levels. No answer for one level or one person, a group with one person, a
combination of levels without a trial, or when no rung of the ladder holds. */
Answer<EffectsModel> FitEffectsModel(const MeasureTable& table);

/** One factor as the quantity it is, with all groups: its slope against `reference`, and whether the
slope differs between groups. No answer as above, and when the factor has no numbers.
@pre factor < table.factors.size(). */
Answer<EffectsModel> FitQuantityModel(const MeasureTable& table, size_t factor,
                                      double reference = 0.0);

/** What varies between persons and sessions, for notes. */
std::string DescribeRandom(const EffectsModel& model);

}  // namespace graspbench
