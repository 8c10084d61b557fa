#include "workbench/experiments/explain_grasp.h"

#include "core/base/config.h"

namespace graspbench {
namespace {

/** The value under a full key, "drives.law". */
Json FindValue(const Json& config, const std::string& key) {
  const Json* at = &config;
  size_t start = 0;
  for (size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', start)) {
    at = &at->at(key.substr(start, dot - start));
    start = dot + 1;
  }
  return at->at(key.substr(start));
}

std::string FormatValue(const Json& value) {
  return value.is_string() ? value.get<std::string>() : FormatJson(value);
}

}  // namespace

std::vector<ExplainStep> ExplainGrasp(const GraspInputs& inputs, const GraspInput& input,
                                      const FreeSpaceProfile& from, const FreeSpaceProfile& to) {
  FreeSpaceProfile profile = from;
  std::vector<ExplainStep> steps = {{"", "", "", JudgeGraspInput(inputs, input, profile), false}};
  const Json before = ConfigToJson(from), after = ConfigToJson(to);
  for (const std::string& key : ListConfigKeys(from)) {
    const Json a = FindValue(before, key), b = FindValue(after, key);
    if (a == b || key == "about" || key == "source") continue;
    SetConfigValue(key + "=" + FormatValue(b), profile);
    ExplainStep step{key, FormatValue(a), FormatValue(b), JudgeGraspInput(inputs, input, profile),
                     false};
    step.turns = step.result.passed != steps.back().result.passed;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace graspbench
