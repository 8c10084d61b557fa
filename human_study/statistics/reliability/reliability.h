#pragma once
/** @file
Reliability of single trials of a measure, from repeated trials of several persons in one condition.

With s_w^2 the mean square within persons:
- within-person standard deviation s_w; it is also the standard error of measurement (SEM) of a
  single trial; SEM / sqrt(k) for the mean of k;
- minimal detectable change z sqrt(2) SEM with z = 1.959964, the normal quantile at 0.975: a
  smaller difference between two single trials may be error (J. P. Weir, J. Strength Cond. Res. 19
  (2005));
- trials needed for the mean of k to reach a wanted ICC (Spearman and Brown, 1910):
  k = wanted (1 - ICC(1,1)) / (ICC(1,1) (1 - wanted)), rounded up.

Practice and fatigue over trials count as variation within the person. */

#include <string>
#include <string_view>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/statistics/location_tests.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

/* Intraclass correlations of repeated trials: the share of the variance that is due to persons.

Forms and names after Shrout and Fleiss (Psychol. Bull. 86 (1979)), with MS_P between persons, MS_W
within persons, MS_T between trials, MS_E the residual, n persons, k trials each:

    trials are exchangeable        ICC(1,1) = (MS_P - MS_W) / (MS_P + (k - 1) MS_W)
    agreement: practice counts     ICC(2,1) = (MS_P - MS_E)
                                              / (MS_P + (k - 1) MS_E + k (MS_T - MS_E) / n)
    consistency: it does not       ICC(3,1) = (MS_P - MS_E) / (MS_P + (k - 1) MS_E)

and ICC(.,k) for the mean of k trials. Intervals of the second form follow McGraw and Wong
(Psychol. Methods 1 (1996)); the others are exact for normal values. An estimate is negative if
persons differ less than expected from the spread of their trials.

Only in the first form may persons have different numbers of trials: k becomes
k0 = (N - sum n_i^2 / N) / (n - 1), and the interval is that of Thomas and Hultquist (Ann. Stat. 6
(1978)), from the variance of the persons' means and the harmonic mean of n_i. */

/** One person's trials in one condition, in order. NaN is missing. */
struct PersonTrials {
  std::string person;
  std::vector<double> values;
};

/** Lists the trials of one cell of the design, with persons and trials in order of appearance.
Persons without a row there are not listed. No answer for the reasons of CalcCellMeans.
@pre cell < ListCells(table.factors).size(). */
Answer<std::vector<PersonTrials>> ListTrials(const MeasureTable& table, size_t cell);

enum class IccForm { kOneWay, kAgreement, kConsistency };

struct Icc {
  IccForm form = IccForm::kOneWay;
  double num_trials = 1.0;  ///< number averaged: 1, or the trials per person (k0 if unequal)
  double value = 0.0;
  Interval interval;  ///< 95 %
};

/** "ICC(2,1)", "ICC(2,k)". */
std::string NameOf(const Icc& icc);

struct IccPair {
  Icc single;   ///< of one trial
  Icc average;  ///< of the mean of all trials
};

/** No answer below two persons with a value, without a person with two values, or when no person's
trials differ. For the two-way forms also none when persons have different numbers of trials, a
trial is missing, or the residual has no spread. */
Answer<IccPair> CalcIcc(const std::vector<PersonTrials>& persons, IccForm form);

struct TrialsNeeded {
  double wanted_icc = 0.9;
  int num_trials = 0;
  int fewest = 0;    ///< at the upper limit of the ICC's interval
  Answer<int> most;  ///< at the lower limit; none when that is not positive
};

struct Reliability {
  int num_persons = 0;  ///< persons with a value
  int num_values = 0;
  int num_missing = 0;
  double mean = 0.0;  ///< mean of the persons' means
  double within_person_sd = 0.0;
  Interval within_person_interval;  ///< 95 %
  double between_person_sd = 0.0;   ///< of true values; 0 when the estimated variance is negative
  double minimal_detectable_change = 0.0;
  Answer<IccPair> one_way, agreement, consistency;
  Answer<TrialsNeeded> trials_needed;
};

/** Returns z sqrt(2) times the within-person standard deviation, see above. */
double CalcMinimalDetectableChange(double within_person_sd);

/** No answer below two persons, without a person with two trials, when trials of a person never
differ, or with an infinite value. @pre 0 < wanted_icc < 1. */
Answer<Reliability> CalcReliability(const std::vector<PersonTrials>& persons,
                                    double wanted_icc = 0.9);

/** No answer unless the ICC is positive. @pre single.num_trials == 1, 0 < wanted_icc < 1. */
Answer<TrialsNeeded> CalcTrialsNeeded(const Icc& single, double wanted_icc);

/** Test-retest reliability between sessions.

There is one value per person and session: the mean over the condition means. From these follow the
reliability of a single session (ICC(2,1) when a shift between sessions counts as error, ICC(3,1)
when it does not), SEM, minimal detectable change, and the shift itself. */
struct SessionShift {
  size_t a = 0, b = 0;  ///< consecutive sessions, a then b
  Answer<TTest> test;   ///< of b - a
};

struct Retest {
  std::vector<std::string> sessions;  ///< in the order of the table
  std::vector<PersonTrials> persons;  ///< those with a value in every condition of every session
  std::vector<LeftOut> left_out;
  Answer<Reliability> reliability;  ///< of one session
  std::vector<SessionShift> shifts;
};

/** No answer without two sessions, with a trial outside of all sessions, or when no person has a
value in every condition of every session. */
Answer<Retest> CalcRetest(const MeasureTable& table);

}  // namespace graspbench
