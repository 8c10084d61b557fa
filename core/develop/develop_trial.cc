#include "core/develop/develop_trial.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/trial/measures/palm_contact.h"

namespace graspbench {
namespace {

constexpr double kFirmness = 0.3;
constexpr double kPalm = 0.6;
constexpr double kAllDigits = 0.2;
constexpr double kSidesScore = 0.15;
constexpr double kEarly = 0.3;
constexpr double kTouching = 0.3;
constexpr double kLifting = 0.2;
constexpr double kSlightPull = 0.2;  // [N]

/** Digits that touched, of those that grasp. */
double CalcTouchingShare(const TrialResult& result) {
  if (result.contacts.empty()) return 0.0;
  const auto num_touched =
      std::count_if(result.contacts.begin(), result.contacts.end(),
                    [](const DigitContact& contact) { return !std::isnan(contact.time); });
  return static_cast<double>(num_touched) / static_cast<double>(result.contacts.size());
}

}  // namespace

DevelopTrial MakeDevelopTrial(const Grasp& grasp, const GraspObject& object,
                              const TrialResult& result) {
  DevelopTrial trial;
  trial.outcome = result.outcome;
  if (IsNumericalFailure(result.outcome)) return trial;
  if (IsSuccess(result.outcome)) {
    const double weight = object.mass_properties.mass * kStandardGravity;
    const double sigma = std::isfinite(result.stability.sigma) ? result.stability.sigma : 0.0;
    const double x = std::max(0.0, sigma) / (weight + kSlightPull);
    trial.score = 1.0 + kFirmness * x / (1.0 + x);
    trial.score += kAllDigits * CalcTouchingShare(result);
    if (grasp.palm_may_touch && TouchesPalmAtEnd(result)) trial.score += kPalm;
    if (grasp.type == GraspType::kTwoFingerPinch && result.opposition == Opposition::kSide) {
      trial.score += kSidesScore;
    }
    if (result.timing.contact_before_start) trial.score -= kEarly;
    return trial;
  }
  trial.score = kTouching * CalcTouchingShare(result);
  trial.score += kLifting * std::clamp(result.lift_height / grasp.approach_distance, 0.0, 1.0);
  return trial;
}

double CalcMeanScore(const std::vector<DevelopTrial>& trials) {
  double sum = 0.0;
  for (const DevelopTrial& trial : trials) sum += trial.score;
  return trials.empty() ? 0.0 : sum / static_cast<double>(trials.size());
}

int CountSuccesses(const std::vector<DevelopTrial>& trials) {
  return static_cast<int>(std::count_if(
      trials.begin(), trials.end(), [](const DevelopTrial& t) { return IsSuccess(t.outcome); }));
}

}  // namespace graspbench
