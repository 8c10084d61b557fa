#include "core/trial/trial_result.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

ContactOrder FindContactOrder(const TrialResult& result) {
  // Standard deviation of a uniform error within a step. Two of them cover 0.8 steps.
  const double uncertainty = result.simulated_time / result.num_steps / std::sqrt(12.0);
  return FindContactOrder(result.contacts,
                          std::vector<double>(result.contacts.size(), uncertainty));
}

void CheckOneThumb(const std::vector<DigitContact>& contacts, const char* where) {
  if (std::count_if(contacts.begin(), contacts.end(),
                    [](const DigitContact& contact) { return contact.is_opposing; }) > 1) {
    throw Error(ErrorKind::kFormat, std::string(where) + ": more than one thumb");
  }
}

Json DigitsToJson(const TrialResult& result) {
  Json digits = Json::array();
  for (size_t i = 0; i < result.contacts.size(); ++i) {
    digits.push_back(RecordToJson(result.contacts[i]));
    digits.back().update(RecordToJson(result.touches[i]));
  }
  return digits;
}

void ReadDigits(const Json& json, TrialResult& result) {
  for (const Json& digit : json) {
    ReadRecord(digit, result.contacts.emplace_back());
    ReadRecord(digit, result.touches.emplace_back());
  }
  CheckOneThumb(result.contacts, "contacts");
}

void ReadDigitsText(JsonCursor& text, TrialResult& result) {
  ReadListText(text, [&] {
    text.Demand("{");
    ReadFieldsText(text, result.contacts.emplace_back());
    ReadFieldsText(text, result.touches.emplace_back(), /*is_first=*/false);
    text.Demand("}");
  });
  const auto is_thumb = [](const DigitContact& contact) { return contact.is_opposing; };
  if (std::count_if(result.contacts.begin(), result.contacts.end(), is_thumb) > 1) text.Fail();
}

Json ToJson(const TrialResult& result) { return RecordToJson(result); }

TrialResult TrialResultFromJson(const Json& json) {
  TrialResult result;
  ReadRecord(json, result);
  result.timing = CalcContactTiming(result.contacts, 0.0);
  return result;
}

TrialResult ReadTrialResultText(JsonCursor& text) {
  TrialResult result;
  ReadRecordText(text, result);
  if (!text.has_failed()) result.timing = CalcContactTiming(result.contacts, 0.0);
  return result;
}

}  // namespace graspbench
