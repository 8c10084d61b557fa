#include "core/trial/trial_result.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

ContactOrder FindContactOrder(const TrialResult& result) {
  // Standard deviation of a uniform error within a step. Two of them explain 0.8 steps.
  const double uncertainty = result.simulated_time / result.num_steps / std::sqrt(12.0);
  return FindContactOrder(result.contacts,
                          std::vector<double>(result.contacts.size(), uncertainty));
}

Json DigitsToJson(const TrialResult& result) {
  Json digits = Json::array();
  for (size_t i = 0; i < result.contacts.size(); ++i) {
    const DigitContact& contact = result.contacts[i];
    const DigitTouch& touch = result.touches[i];
    digits.push_back({{"digit", contact.digit},
                      {"is_thumb", contact.is_opposing},
                      {"time_s", JsonNumber(contact.time)},
                      {"closing", JsonNumber(touch.closing)},
                      {"q_rad", std::vector<double>(touch.q.begin(), touch.q.end())},
                      {"smallest_gap_m", JsonNumber(touch.smallest_gap)}});
  }
  return digits;
}

void ReadDigits(const Json& json, TrialResult& result) {
  for (const Json& digit : json) {
    result.contacts.push_back({digit.at("digit").get<std::string>(),
                               digit.at("is_thumb").get<bool>(), NumberFrom(digit.at("time_s"))});
    DigitTouch& touch = result.touches.emplace_back();
    touch.closing = NumberFrom(digit.at("closing"));
    internal::ReadField(digit.at("q_rad"), touch.q);
    touch.smallest_gap = NumberFrom(digit.at("smallest_gap_m"));
  }
  if (std::count_if(result.contacts.begin(), result.contacts.end(),
                    [](const DigitContact& contact) { return contact.is_opposing; }) > 1) {
    throw Error(ErrorKind::kFormat, "contacts: more than one thumb");
  }
}

Json ToJson(const TrialResult& result) { return RecordToJson(result); }

TrialResult TrialResultFromJson(const Json& json) {
  TrialResult result;
  ReadRecord(json, result);
  result.timing = CalcContactTiming(result.contacts, 0.0);
  return result;
}

}  // namespace graspbench
