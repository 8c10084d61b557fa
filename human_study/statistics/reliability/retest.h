#pragma once
/** @file
Test and retest: does a person show the same in another session?

One value a person and session: the mean over the conditions of the means of their trials. Of these
the reliability of single sessions (reliability.h): ICC(2,1) when a shift from session to session
counts as error, ICC(3,1) when it does not, SEM, minimal detectable change; and the shift itself. */

#include <string>
#include <vector>

#include "human_study/statistics/reliability/reliability.h"
#include "human_study/statistics/t_tests.h"

namespace graspbench {

struct SessionShift {
  size_t a = 0, b = 0;  ///< sessions, b the next of a
  Answer<TTest> test;   ///< of b - a
};

struct Retest {
  std::vector<std::string> sessions;  ///< in the table's order
  std::vector<PersonTrials> persons;  ///< with a value in every condition of every session
  std::vector<LeftOut> left_out;
  Answer<Reliability> reliability;  ///< of one session
  std::vector<SessionShift> shifts;
};

/** No answer without two sessions, with a trial of none of them, or when nobody has a value in every
condition of every session. */
Answer<Retest> CalcRetest(const MeasureTable& table);

}  // namespace graspbench
