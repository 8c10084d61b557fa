#include "core/optimise/learning_trial.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr double kFarAway = 1.0;  ///< the distance of a digit that was never measured [m]

}  // namespace

LearningTrial MakeLearningTrial(int draw, const TrialResult& result, bool keep_postures) {
  LearningTrial trial;
  trial.draw = draw;
  trial.outcome = result.outcome;
  trial.sigma = std::isfinite(result.stability.sigma) ? result.stability.sigma : 0.0;
  trial.stability = result.stability.hold;
  trial.contacts = result.contacts;
  trial.timing = result.timing;
  trial.opposing_gap = kFarAway;
  for (size_t d = 0; d < result.touches.size(); ++d) {
    trial.closings.push_back(result.touches[d].closing);
    if (keep_postures) trial.touch_postures.push_back(result.touches[d].q);
    const double gap = result.touches[d].smallest_gap;
    if (result.contacts[d].is_opposing && std::isfinite(gap)) trial.opposing_gap = gap;
  }
  return trial;
}

double CalcFitness(const LearningTrial& trial) {
  const bool is_missing =
      trial.contacts.empty() ||  // the simulation gave up
      std::any_of(trial.contacts.begin(), trial.contacts.end(), [](const DigitContact& contact) {
        return contact.is_opposing && std::isnan(contact.time);
      });
  return is_missing ? -trial.opposing_gap : trial.sigma;
}

double CalcFitness(const std::vector<LearningTrial>& trials) {
  GRASPBENCH_DEMAND(!trials.empty(), "no trials");
  double sum = 0.0;
  for (const LearningTrial& trial : trials) sum += CalcFitness(trial);
  return sum / static_cast<double>(trials.size());
}

Json ToJson(const LearningTrial& trial) {
  Json digits = Json::array();
  for (size_t d = 0; d < trial.contacts.size(); ++d) {
    digits.push_back({{"digit", trial.contacts[d].digit},
                      {"is_thumb", trial.contacts[d].is_opposing},
                      {"time_s", JsonNumber(trial.contacts[d].time)},
                      {"closing", JsonNumber(trial.closings[d])}});
    if (trial.touch_postures.empty()) continue;
    const Eigen::VectorXd& q = trial.touch_postures[d];
    digits.back()["q_rad"] = std::vector<double>(q.begin(), q.end());
  }
  const StabilityPart& part = trial.stability;
  return Json{{"draw", trial.draw},
              {"outcome", NameOf(trial.outcome)},
              {"sigma", trial.sigma},
              {"quality", JsonNumber(part.quality)},
              {"normal_force_n", JsonNumber(part.normal_force)},
              {"slip_speed_m_per_s", JsonNumber(part.slip_speed)},
              {"opposition", JsonNumber(part.opposition)},
              {"opposing_gap_m", trial.opposing_gap},
              {"digits", digits}};
}

LearningTrial LearningTrialFromJson(const Json& json) {
  LearningTrial trial;
  trial.draw = IntFrom(json.at("draw"));
  trial.outcome = OutcomeFromName(json.at("outcome").get<std::string>());
  trial.sigma = json.at("sigma").get<double>();
  trial.stability.quality = NumberFrom(json.at("quality"));
  trial.stability.normal_force = NumberFrom(json.at("normal_force_n"));
  trial.stability.slip_speed = NumberFrom(json.at("slip_speed_m_per_s"));
  trial.stability.opposition = NumberFrom(json.at("opposition"));
  trial.opposing_gap = json.at("opposing_gap_m").get<double>();
  int num_thumbs = 0;
  for (const Json& digit : json.at("digits")) {
    trial.contacts.push_back({digit.at("digit").get<std::string>(),
                              digit.at("is_thumb").get<bool>(), NumberFrom(digit.at("time_s"))});
    trial.closings.push_back(NumberFrom(digit.at("closing")));
    if (const auto angles = digit.find("q_rad"); angles != digit.end()) {
      const auto q = angles->get<std::vector<double>>();
      trial.touch_postures.push_back(
          Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
    }
    num_thumbs += trial.contacts.back().is_opposing;
  }
  if (num_thumbs > 1) throw Error(ErrorKind::kFormat, "digits: more than one thumb");
  trial.timing = CalcContactTiming(trial.contacts, 0.0);
  return trial;
}

}  // namespace graspbench
