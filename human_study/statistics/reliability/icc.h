#pragma once
/** @file
Intraclass correlations of repeated trials: the share of the variance that is due to persons.

Forms and names after Shrout and Fleiss (Psychol. Bull. 86 (1979)), with MS_P between persons, MS_W
within persons, MS_T between trials, MS_E the rest, n persons, k trials each:

    trials are exchangeable        ICC(1,1) = (MS_P - MS_W) / (MS_P + (k - 1) MS_W)
    agreement: practice counts     ICC(2,1) = (MS_P - MS_E)
                                              / (MS_P + (k - 1) MS_E + k (MS_T - MS_E) / n)
    consistency: it does not       ICC(3,1) = (MS_P - MS_E) / (MS_P + (k - 1) MS_E)

and ICC(.,k) for the mean of k trials. Intervals of the second form after McGraw and Wong (Psychol.
Methods 1 (1996)), the others exact for normal values. An estimate may be negative: persons differ
less than their trials let expect.

Persons may have different numbers of trials in the first form alone: k becomes
k0 = (N - sum n_i^2 / N) / (n - 1), and the interval is that of Thomas and Hultquist (Ann. Stat. 6
(1978)), from the variance of the persons' means and the harmonic mean of n_i. */

#include <string>
#include <string_view>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

/** One person's trials in one condition, in order. NaN is missing. */
struct PersonTrials {
  std::string person;
  std::vector<double> values;
};

/** The trials of one cell of the design, persons and trials in order of appearance. Persons without
a row there are not listed. No answer for the faults of CalcCellMeans.
@pre cell < ListCells(table.factors).size(). */
Answer<std::vector<PersonTrials>> ListTrials(const MeasureTable& table, size_t cell);

enum class IccForm { kOneWay, kAgreement, kConsistency };

struct Icc {
  IccForm form = IccForm::kOneWay;
  double num_trials = 1.0;  ///< averaged: 1, or the trials a person has (k0 when they differ)
  double value = 0.0;
  Interval interval;  ///< 95 %
};

/** "ICC(2,1)", "ICC(2,k)". */
std::string NameOf(const Icc& icc);

struct IccPair {
  Icc single;   ///< of one trial
  Icc average;  ///< of the mean of all trials
};

/** No answer below two persons with a value, without any person with two, when the trials of no
person differ; for the two-way forms also when persons have different numbers of trials, a trial is
missing, or the rest has no spread. */
Answer<IccPair> CalcIcc(const std::vector<PersonTrials>& persons, IccForm form);

}  // namespace graspbench
