#include "core/statistics/noncentral_t.h"

#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/non_central_t.hpp>

namespace graspbench {

double CalcNoncentralStudentUpperP(double t, double df, double shift) {
  namespace bm = boost::math;
  return bm::cdf(bm::complement(bm::non_central_t(df, shift), t));
}

}  // namespace graspbench
