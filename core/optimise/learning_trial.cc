#include "core/optimise/learning_trial.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

constexpr double kFarAway = 1.0;   ///< distance of a digit that was not measured [m]
constexpr double kGapForce = 1.0;  ///< penalty for a lost object [N/m]

}  // namespace

LearningTrial MakeLearningTrial(int draw, const TrialResult& result, bool keep_postures) {
  LearningTrial trial;
  trial.draw = draw;
  trial.outcome = result.outcome;
  trial.sigma = std::isfinite(result.stability.sigma) ? result.stability.sigma : 0.0;
  trial.stability = result.stability.hold;
  trial.contacts = result.contacts;
  trial.strength = result.strength;
  trial.timing = CalcContactTiming(result.contacts, 0.0);  // NaN when the simulation failed
  trial.opposing_gap = kFarAway;
  for (size_t d = 0; d < result.touches.size(); ++d) {
    trial.closings.push_back(result.touches[d].closing);
    if (keep_postures) trial.touch_postures.push_back(result.touches[d].q);
    const double gap = result.touches[d].smallest_gap;
    if (result.contacts[d].is_opposing && std::isfinite(gap)) trial.opposing_gap = gap;
  }
  return trial;
}

double CalcFitness(const LearningTrial& trial, double grip_limit) {
  const bool is_missing =
      trial.contacts.empty() ||  // the simulation failed
      std::any_of(trial.contacts.begin(), trial.contacts.end(), [](const DigitContact& contact) {
        return contact.is_opposing && std::isnan(contact.time);
      });
  const double grip = trial.stability.normal_force;
  const auto limit = [&](double value) {
    return grip > grip_limit ? value * grip_limit / grip : value;
  };
  if (!trial.strength) return is_missing ? -trial.opposing_gap : limit(trial.sigma);
  if (*trial.strength > 0.0) return limit(*trial.strength);
  return *trial.strength - (is_missing ? kGapForce * trial.opposing_gap : 0.0);
}

double CalcFitness(const std::vector<LearningTrial>& trials, double grip_limit) {
  GRASPBENCH_DEMAND(!trials.empty(), "no trials");
  std::vector<double> values;
  for (const LearningTrial& trial : trials) values.push_back(CalcFitness(trial, grip_limit));
  return CalcMean(values);
}

Json LearningDigitsToJson(const LearningTrial& trial) {
  Json digits = Json::array();
  for (size_t d = 0; d < trial.contacts.size(); ++d) {
    digits.push_back(RecordToJson(trial.contacts[d]));
    digits.back()["closing"] = JsonNumber(trial.closings[d]);
    if (!trial.touch_postures.empty()) digits.back()["q_rad"] = JsonAngles(trial.touch_postures[d]);
  }
  return digits;
}

void ReadLearningDigits(const Json& json, LearningTrial& trial) {
  for (const Json& digit : json) {
    ReadRecord(digit, trial.contacts.emplace_back());
    trial.closings.push_back(NumberFrom(digit.at("closing")));
    if (digit.contains("q_rad")) trial.touch_postures.push_back(AnglesFrom(digit.at("q_rad")));
  }
  CheckOneThumb(trial.contacts, "digits");
}

std::vector<std::vector<DigitContact>> ListContacts(const std::vector<LearningTrial>& trials) {
  std::vector<std::vector<DigitContact>> contacts;
  for (const LearningTrial& trial : trials) contacts.push_back(trial.contacts);
  return contacts;
}

int CountSuccesses(const std::vector<LearningTrial>& trials) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), [](const auto& trial) {
    return trial.outcome == Outcome::kSuccess;
  }));
}

double CalcMeanStrength(const std::vector<LearningTrial>& trials) {
  std::vector<double> strengths;
  for (const LearningTrial& trial : trials) {
    if (trial.strength) strengths.push_back(std::max(0.0, *trial.strength));
  }
  return CalcMean(strengths);
}

double CalcMeanGrip(const std::vector<LearningTrial>& trials) {
  std::vector<double> grips;
  for (const LearningTrial& trial : trials) {
    if (std::isfinite(trial.stability.normal_force)) grips.push_back(trial.stability.normal_force);
  }
  return CalcMean(grips);
}

Json ToJson(const LearningTrial& trial) { return RecordToJson(trial); }

LearningTrial LearningTrialFromJson(const Json& json) {
  LearningTrial trial;
  ReadRecord(json, trial);
  trial.timing = CalcContactTiming(trial.contacts, 0.0);
  return trial;
}

double CalcFrictionBound(double normal_force, double friction, double weight) {
  return std::max(0.0, friction * normal_force - weight);
}

double CalcMostGain(double share) { return std::max(1.0, 1.0 / share); }

Headroom CalcHeadroom(const std::vector<LearningTrial>& trials, const GraspObject& object,
                      double gravity) {
  const double weight = object.mass_properties.mass * gravity;
  std::vector<double> bounds, loads;
  for (const LearningTrial& trial : trials) {
    const double load = trial.strength.value_or(trial.sigma);
    if (!(load > 0.0)) continue;
    bounds.push_back(
        CalcFrictionBound(trial.stability.normal_force, object.surface.friction_static, weight));
    loads.push_back(load);
  }
  const double bound = CalcMean(bounds);
  return {bound, CalcMean(loads) / bound};
}

}  // namespace graspbench
