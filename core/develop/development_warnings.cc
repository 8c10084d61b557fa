#include "core/develop/development_warnings.h"

#include <fmt/core.h>

#include "core/develop/digit_opposition.h"

namespace graspbench {
namespace {

constexpr double kMostFailures = 0.01;  // numerical ones, of the trials
constexpr double kLeastHeld = 0.1;      // of the check's shapes
constexpr double kHalf = 0.5;           // of them, below which two digits are asked why

}  // namespace

std::vector<std::string> ListDevelopmentWarnings(const Hand& hand,
                                                 const DevelopedGrasp& developed) {
  std::vector<std::string> warnings;
  const int num_held = CountSuccesses(developed.check);
  const auto num_shapes = static_cast<double>(developed.check.size());
  if (num_held < kLeastHeld * num_shapes) {
    warnings.push_back(fmt::format(
        "it held {} of {} shapes not met before; not to be relied on (a larger --budget, another "
        "--seed may find a better one)",
        num_held, developed.check.size()));
  }
  if (num_held < kHalf * num_shapes && developed.grasp.digits.size() == 2) {
    for (const std::string& pair : ListPairsApart(hand, developed.grasp.digits)) {
      warnings.push_back(pair);
    }
  }
  const int num_failed = developed.num_numerical_failures;
  if (num_failed > kMostFailures * developed.num_trials) {
    warnings.push_back(fmt::format(
        "{} of {} trials ({:.1f} %) failed numerically and count as not held, so the scores are "
        "too low (look at masses, inertias and drives of the hand)",
        num_failed, developed.num_trials, 100.0 * num_failed / developed.num_trials));
  }
  return warnings;
}

}  // namespace graspbench
