#include "datasets/records/compare_results.h"

#include "core/base/text/json.h"

namespace graspbench {
namespace {

std::optional<FieldDifference> Compare(const Json& a, const Json& b) {
  const Json changes = Json::diff(a, b);  // RFC 6902, in the order of the fields
  if (changes.empty()) return std::nullopt;
  const auto path = changes.front().at("path").get<std::string>();
  const auto format = [&path](const Json& json) {
    const Json::json_pointer place(path);
    return json.contains(place) ? FormatJson(json.at(place)) : std::string("missing");
  };
  return FieldDifference{path.substr(1), format(a), format(b)};
}

}  // namespace

std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                   const TrialResult& now) {
  return Compare(ToJson(recorded), ToJson(now));
}

std::optional<FieldDifference> FindFirstDifference(const TrialRecord& recorded,
                                                   const TrialRecord& now) {
  const auto difference = Compare(ToJson(recorded.plan), ToJson(now.plan));
  return difference ? difference : FindFirstDifference(recorded.result, now.result);
}

}  // namespace graspbench
