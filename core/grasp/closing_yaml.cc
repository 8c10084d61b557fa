#include "core/grasp/closing_yaml.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {

void ReadClosing(const std::string& file, const std::string& where, Diagnostics& problems,
                 const FileKeys& keys, const std::string& prefix, YamlMap& map, Grasp& grasp) {
  const YAML::Node node = map.Child("closing", Needed::kNo);
  if (node.IsNull()) return;
  YamlMap digits(node, file, where + "closing", problems);
  for (const std::string& id : grasp.digits) {
    const YAML::Node child = digits.Child(id, Needed::kNo);
    if (child.IsNull()) continue;
    YamlMap of_digit(child, file, where + "closing of " + id, problems, &keys,
                     prefix + "closing.DIGIT.");
    ClosingSchedule schedule;
    of_digit.Read("delay_s", schedule.delay, Needed::kNo);
    of_digit.Read("speed", schedule.speed, Needed::kNo);
    of_digit.FinishKnownKeys();
    if (!(schedule == ClosingSchedule())) grasp.closing[id] = schedule;
  }
  digits.FinishKnownKeys();
}

std::string FormatClosing(const Grasp& grasp) {
  std::string text;
  for (const auto& [digit, schedule] : grasp.closing) {
    text += fmt::format("{}{}: {{delay_s: {:.6f}, speed: {:.6f}}}", text.empty() ? "" : ", ", digit,
                        schedule.delay, schedule.speed);
  }
  return "{" + text + "}";
}

}  // namespace graspbench
