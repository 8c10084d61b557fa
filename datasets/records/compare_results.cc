#include "datasets/records/compare_results.h"

#include <algorithm>

#include "core/base/text/json.h"

namespace graspbench {
namespace {

/** The first in the order of the fields. @param a, b  null pointers where the field is missing.
@param field  of both; empty: the whole. */
std::optional<FieldDifference> Compare(const Json* a, const Json* b, const std::string& field) {
  const auto format = [](const Json* json) { return json ? FormatJson(*json) : "missing"; };
  if (a == nullptr || b == nullptr) return FieldDifference{field, format(a), format(b)};
  if (*a == *b) return std::nullopt;
  const std::string before = field.empty() ? "" : field + "/";
  std::optional<FieldDifference> difference;
  if (a->is_array() && b->is_array()) {
    const auto find = [](const Json& json, size_t i) {
      return i < json.size() ? &json[i] : nullptr;
    };
    for (size_t i = 0; i < std::max(a->size(), b->size()) && !difference; ++i) {
      difference = Compare(find(*a, i), find(*b, i), before + std::to_string(i));
    }
    return difference;
  }
  if (a->is_object() && b->is_object()) {
    for (const Json* const json : {a, b}) {
      for (const auto& [key, value] : json->items()) {
        if (!difference) difference = Compare(a->find(key), b->find(key), before + key);
      }
    }
    return difference;
  }
  return FieldDifference{field, format(a), format(b)};
}

std::optional<FieldDifference> Compare(const Json& a, const Json& b) { return Compare(&a, &b, ""); }

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
