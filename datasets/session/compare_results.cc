#include "datasets/session/compare_results.h"

#include "core/base/json.h"

namespace graspbench {

std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                   const TrialResult& now) {
  const Json a = ToJson(recorded), b = ToJson(now);
  const Json changes = Json::diff(a, b);  // RFC 6902, in the order of the fields
  if (changes.empty()) return std::nullopt;
  const auto path = changes.front().at("path").get<std::string>();
  const auto format = [&path](const Json& json) {
    const Json::json_pointer place(path);
    return json.contains(place) ? FormatJson(json.at(place)) : std::string("missing");
  };
  return FieldDifference{path.substr(1), format(a), format(b)};
}

}  // namespace graspbench
