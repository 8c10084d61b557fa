#include "datasets/plan/conditions.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/plan/input_copies.h"

namespace graspbench {
namespace {

constexpr double kLongestDelay = 10.0;  // [s]

/** Keys of conditions that are none of a session. */
constexpr const char* kGrasp = "grasp";
constexpr const char* kLast = "delay.last";
constexpr const char* kFirst = "delay.first";
constexpr const char* kBackend = "backend";
constexpr const char* kImplicit = "implicit";
constexpr const char* kCompliant = "compliant";

/** What leaves the draws of a trial, as key or as group of keys. */
const std::vector<std::string> kComparable = {"variation",     "strategy",    "sim",    "model",
                                              "imperfections", "positioning", "camera", "touch",
                                              "sensors",       "approach"};

struct Assignment {
  std::string key, value;
};

/** Blanks around key and value do not count. */
Assignment Split(const std::string& text) {
  const size_t sign = text.find('=');
  const auto trim = [](const std::string& part) {
    const size_t first = part.find_first_not_of(" \t");
    return first == part.npos ? std::string()
                              : part.substr(first, part.find_last_not_of(" \t") + 1 - first);
  };
  if (sign == text.npos) return {trim(text), ""};
  return {trim(text.substr(0, sign)), trim(text.substr(sign + 1))};
}

double ParseDelay(const Assignment& setting) {
  double delay = -1.0;
  const char* const end = setting.value.data() + setting.value.size();
  const auto read = std::from_chars(setting.value.data(), end, delay);
  if (read.ec == std::errc() && read.ptr == end && delay >= 0.0 && delay <= kLongestDelay) {
    return delay;
  }
  throw Error(ErrorKind::kRange, setting.key + "=" + setting.value +
                                     ": expected a time from 0 to " + FormatJson(kLongestDelay) +
                                     " s");
}

/** Puts one setting into effect. */
void Apply(const std::string& text, ConditionInputs& made) {
  const Assignment setting = Split(text);
  if (setting.key == kLast || setting.key == kFirst) {
    const double delay = ParseDelay(setting);
    if (delay == 0.0) return;
    if (made.late != LateDigit::kNone) {
      throw Error(ErrorKind::kUsage,
                  "a condition cannot delay two digits; set delay.last or "
                  "delay.first");
    }
    made.late = setting.key == kLast ? LateDigit::kLast : LateDigit::kFirst;
    made.delay = delay;
  } else if (setting.key == kBackend) {
    if (setting.value != kImplicit && setting.value != kCompliant) {
      throw Error(ErrorKind::kUsage, "no backend \"" + setting.value + "\"" +
                                         SuggestNames(setting.value, {kImplicit, kCompliant}));
    }
    made.is_compliant = setting.value == kCompliant;
  } else if (setting.key == kGrasp) {
    if (setting.value.empty() || setting.value == "all" || IsGraspFile(setting.value) ||
        setting.value.find(',') != setting.value.npos) {
      throw Error(ErrorKind::kUsage, "grasp=" + setting.value +
                                         ": expected best or the id of one grasp, as g1; a grasp "
                                         "file is named by --grasp, for all conditions");
    }
    made.config.grasps = {setting.value};
  } else {
    ApplySetting(text, made.config);
  }
}

}  // namespace

std::string NormaliseSetting(const std::string& assignment, const SessionConfig& config) {
  const Assignment setting = Split(assignment);
  const std::string& key = setting.key;
  ConditionInputs made;
  made.config = config;
  made.config.conditions.clear();
  Apply(assignment, made);
  if (key == kLast || key == kFirst) return key + "=" + FormatJson(ParseDelay(setting));
  if (key == kBackend || key == kGrasp) return key + "=" + setting.value;
  const SessionConfig& changed = made.config;
  const std::string group = key.substr(0, key.find('.'));
  if (std::find(kComparable.begin(), kComparable.end(), group) == kComparable.end()) {
    throw Error(ErrorKind::kUsage, "\"" + key +
                                       "\" decides which trials there are; only what leaves their "
                                       "draws can be compared pair by pair: variation.*, "
                                       "strategy.*, sim.*, model.*, imperfections.*, "
                                       "positioning, camera.*, touch, sensors.*, approach, grasp, "
                                       "delay.last, delay.first, backend");
  }
  if ((group == "camera" || group == "sensors") && !ToJson(changed).contains(group)) {
    throw Error(ErrorKind::kUsage,
                "\"" + key + "\" changes nothing here: the session has " +
                    (group == "camera" ? "positioning: " + config.positioning + ", not camera"
                                       : "touch: " + config.touch + ", not sensed"));
  }
  const std::string level = FindBaseLevel(changed, key);
  if (level != FindBaseLevel(config, key) && ToJson(changed) == ToJson(config)) {
    throw Error(ErrorKind::kUsage, "\"" + key + "=" + level +
                                       "\" changes nothing here: the session's other settings "
                                       "leave no use for it");
  }
  // A session that looks, varied to one that does not, leaves the settings of the camera behind.
  CheckSessionConfig(SessionConfigFromJson(ToJson(changed), assignment));
  return key + "=" + level;
}

ConditionInputs ApplyCondition(const Condition& condition, const SessionConfig& config) {
  ConditionInputs made;
  made.config = config;
  made.config.conditions.clear();
  for (const std::string& setting : condition.settings) Apply(setting, made);
  made.config = SessionConfigFromJson(ToJson(made.config), condition.name);  // only what is used
  CheckSessionConfig(made.config);
  return made;
}

bool HasDelays(const SessionConfig& config) {
  return std::any_of(
      config.conditions.begin(), config.conditions.end(), [](const Condition& condition) {
        return std::any_of(
            condition.settings.begin(), condition.settings.end(),
            [](const std::string& setting) { return setting.rfind("delay.", 0) == 0; });
      });
}

std::string FindBaseLevel(const SessionConfig& config, const std::string& key) {
  if (key == kLast || key == kFirst) return FormatJson(0.0);
  if (key == kBackend) return kImplicit;
  if (key == kGrasp) return config.grasps.size() == 1 ? config.grasps.front() : "";
  const Json json = ConfigToJson(config);
  const Json* value = &json;
  for (size_t start = 0; start <= key.size();) {
    const size_t dot = std::min(key.find('.', start), key.size());
    value = value->find(key.substr(start, dot - start));
    if (value == nullptr) return "";
    start = dot + 1;
  }
  return value->is_string() ? value->get<std::string>() : FormatJson(*value);
}

std::vector<SweepFactor> ListFactors(const SessionConfig& config) {
  std::vector<SweepFactor> factors;
  for (const Condition& condition : config.conditions) {
    for (const std::string& text : condition.settings) {
      const Assignment setting = Split(text);
      auto factor = std::find_if(factors.begin(), factors.end(), [&](const SweepFactor& known) {
        return known.key == setting.key;
      });
      if (factor == factors.end()) {
        factors.push_back({setting.key, {FindBaseLevel(config, setting.key)}});
        factor = std::prev(factors.end());
      }
      std::vector<std::string>& levels = factor->levels;
      if (std::find(levels.begin(), levels.end(), setting.value) == levels.end()) {
        levels.push_back(setting.value);
      }
    }
  }
  return factors;
}

std::string FindLevel(const SessionConfig& config, const std::optional<std::string>& condition,
                      const std::string& key) {
  for (const Condition& known : config.conditions) {
    if (condition != known.name) continue;
    for (const std::string& text : known.settings) {
      const Assignment setting = Split(text);
      if (setting.key == key) return setting.value;
    }
  }
  return FindBaseLevel(config, key);
}

const ThresholdScale* FindThresholdScale(const SessionConfig& config) {
  for (const ThresholdScale& scale : kThresholdScales) {
    const std::string mode = std::string("strategy.grip=") + RowOf(kGripModes, scale.mode).name;
    const auto& conditions = config.conditions;
    const bool is_all =
        !conditions.empty() && conditions.size() % size_t{kMostGripPlace + 1} == 0 &&
        std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
          const auto& settings = condition.settings;
          return std::find(settings.begin(), settings.end(), mode) != settings.end();
        });
    if (is_all) return &scale;
  }
  return nullptr;
}

}  // namespace graspbench
