#pragma once
/** @file
The noncentral t distribution: of a t value when the mean is not zero, from which the power of a t
test is read. */

namespace graspbench {

/** P(T > t) with the noncentrality `shift`, the true difference over its standard error.
@pre df > 0, no NaN; |shift| up to some hundreds. */
double CalcNoncentralStudentUpperP(double t, double df, double shift);

}  // namespace graspbench
