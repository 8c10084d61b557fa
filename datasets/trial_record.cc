#include "datasets/trial_record.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/hash.h"

namespace graspbench {
namespace {

constexpr std::string_view kSumKey = ",\"xxh64\":\"";
constexpr size_t kSumLength = kSumKey.size() + 16 + 2;  // key, digits, quote and brace

}  // namespace

Json ToJson(const PlannedTrial& planned) {
  return Json{{"trial_id", planned.id},
              {"hand", planned.hand},
              {"object", planned.object},
              {"grasp", planned.grasp},
              {"trial", planned.trial}};
}

PlannedTrial PlannedTrialFromJson(const Json& json) {
  return {json.at("trial_id").get<std::string>(), json.at("hand").get<std::string>(),
          json.at("object").get<std::string>(), json.at("grasp").get<std::string>(),
          IntFrom(json.at("trial"))};
}

Json ToJson(const TrialRecord& record) {
  Json json = ToJson(record.plan);
  json["result"] = ToJson(record.result);
  return json;
}

std::string FormatJournalLine(const TrialRecord& record) {
  GRASPBENCH_DEMAND(record.result.outcome != Outcome::kNotRun, record.plan.id);
  std::string line = FormatJson(ToJson(record));
  line.pop_back();  // the closing brace comes back behind the checksum
  const std::string sum = CalcHashHex(line);
  return line.append(kSumKey).append(sum).append("\"}");
}

TrialRecord ParseJournalLine(std::string_view line) {
  const auto fail = [](const std::string& what) { throw Error(ErrorKind::kFormat, what); };
  const size_t body_length = line.size() - std::min(line.size(), kSumLength);
  const std::string_view body = line.substr(0, body_length), tail = line.substr(body_length);
  if (tail.size() != kSumLength || tail.substr(0, kSumKey.size()) != kSumKey ||
      tail.substr(kSumLength - 2) != "\"}") {
    fail("the line is cut off or is no record");
  }
  if (tail.substr(kSumKey.size(), 16) != CalcHashHex(body)) {
    fail("its bytes do not match their checksum");
  }
  try {
    const Json json = Json::parse(line);
    return {PlannedTrialFromJson(json), TrialResultFromJson(json.at("result"))};
  } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
    throw Error(ErrorKind::kFormat, std::string("it is no record of this version: ") + e.what());
  }
}

}  // namespace graspbench
