#include "core/statistics/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace graspbench {
namespace bm = boost::math;

double CalcStudentUpperP(double t, double df) {
  return bm::cdf(bm::complement(bm::students_t(df), t));
}

double CalcStudentTwoSidedP(double t, double df) {
  return 2.0 * CalcStudentUpperP(std::abs(t), df);
}

double CalcStudentQuantile(double probability, double df) {
  return bm::quantile(bm::students_t(df), probability);
}

double CalcFisherUpperP(double f, double df_1, double df_2) {
  return bm::cdf(bm::complement(bm::fisher_f(df_1, df_2), f));
}

double CalcFisherQuantile(double probability, double df_1, double df_2) {
  return bm::quantile(bm::fisher_f(df_1, df_2), probability);
}

double CalcChiSquaredUpperP(double x, double df) {
  return bm::cdf(bm::complement(bm::chi_squared(df), x));
}

double CalcChiSquaredQuantile(double probability, double df) {
  return bm::quantile(bm::chi_squared(df), probability);
}

double CalcBinomialUpperP(int num_successes, int num_trials, double probability) {
  if (num_successes == 0) return 1.0;
  return bm::cdf(bm::complement(bm::binomial(num_trials, probability), num_successes - 1));
}

double CalcNormalP(double z) { return bm::cdf(bm::normal(), z); }

double CalcNormalQuantile(double probability) { return bm::quantile(bm::normal(), probability); }

double CalcNoncentralStudentUpperP(double t, double df, double shift) {
  return bm::cdf(bm::complement(bm::non_central_t(df, shift), t));
}

}  // namespace graspbench
