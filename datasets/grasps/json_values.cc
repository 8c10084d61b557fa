#include "datasets/grasps/json_values.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "datasets/journal/json_fault.h"

namespace graspbench {

Json ParseJsonObject(std::string_view bytes, const std::string& file) {
  Json json;
  try {
    json = Json::parse(bytes);
  } catch (const Json::exception& fault) {
    throw Error(ErrorKind::kFormat, file + " cannot be used: " + DescribeJsonFault(fault));
  }
  if (!json.is_object()) {
    throw Error(ErrorKind::kFormat, file + " holds no JSON object; expected {..}");
  }
  return json;
}

const Json& GetJson(const Json& object, const std::string& key, const std::string& file) {
  const Json* const found = object.find(key);
  if (found == nullptr) {
    throw Error(ErrorKind::kFormat, file + ": the key \"" + key + "\" is missing");
  }
  return *found;
}

std::vector<double> ReadJsonNumbers(const Json& json, const std::string& where, size_t size) {
  if (!json.is_array() || (size > 0 && json.size() != size)) {
    throw Error(ErrorKind::kFormat,
                where +
                    (size == 0 ? ": expected a list of numbers"
                               : fmt::format(": expected a list of {} numbers", size)) +
                    (json.is_array() ? fmt::format(", there are {}", json.size()) : ""));
  }
  std::vector<double> numbers;
  for (const Json& number : json) {
    numbers.push_back(number.is_number() ? number.get<double>() : std::nan(""));
    if (!std::isfinite(numbers.back())) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}[{}]: expected a finite number", where, numbers.size() - 1));
    }
  }
  return numbers;
}

std::vector<bool> ReadJsonLabels(const Json& json, const std::string& where, size_t size) {
  if (!json.is_array() || json.size() != size) {
    throw Error(ErrorKind::kFormat,
                fmt::format("{}: expected a list of {} verdicts, one for each grasp", where, size));
  }
  std::vector<bool> labels;
  for (const Json& label : json) {
    const double number = label.is_boolean()  ? (label.get<bool>() ? 1.0 : 0.0)
                          : label.is_number() ? label.get<double>()
                                              : std::nan("");
    if (number != 0.0 && number != 1.0) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}[{}]: expected true, false, 1 or 0", where, labels.size()));
    }
    labels.push_back(number == 1.0);
  }
  return labels;
}

}  // namespace graspbench
