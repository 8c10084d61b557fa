#include "core/statistics/paired_decision.h"

#include <cmath>

#include "core/base/error.h"
#include "core/statistics/distributions.h"

namespace graspbench {
namespace {

/** Critical values C_K of a one-sided level of 5 %, for K looks from 1. */
constexpr double kOBrienFleming[kMostLooks] = {1.645, 1.678, 1.710, 1.733, 1.751};

/** Non-inferiority score of success below which waiting for more pairs is futile. */
constexpr double kHopeless = -1.0;

}  // namespace

double CalcNonInferiorityScore(const PairedCounts& success) {
  const double n = success.num_pairs(), lost = success.first_only, gained = success.second_only;
  constexpr double m = kSuccessMargin;
  const double b = -(lost + gained) - (2.0 * n + lost - gained) * m;
  const double c = lost * m * (1.0 + m);
  const double q = (std::sqrt(b * b - 8.0 * n * c) - b) / (4.0 * n);
  return (gained - lost + n * m) / std::sqrt(n * (2.0 * q - m * (1.0 + m)));
}

PairedDecision Decide(const PairedEvidence& evidence, int look, int num_looks) {
  GRASPBENCH_DEMAND(look >= 1 && look <= num_looks && num_looks <= kMostLooks, "no such look");
  const double bound = kOBrienFleming[num_looks - 1] * std::sqrt(double(num_looks) / look);
  const auto& [success, num_better, num_worse] = evidence;
  const double score = CalcNonInferiorityScore(success);
  const bool keeps_success = score >= bound;
  const bool is_better =
      CalcBinomialUpperP(num_better, num_better + num_worse, 0.5) <= CalcNormalP(-bound);
  if (keeps_success && is_better) return PairedDecision::kTaken;
  const bool is_last = look == num_looks;
  if (score < (is_last ? 0.0 : kHopeless)) return PairedDecision::kSucceedsLess;
  if (num_better <= num_worse) return PairedDecision::kIsNotBetter;
  return is_last ? PairedDecision::kIsNotDecided : PairedDecision::kGoOn;
}

}  // namespace graspbench
