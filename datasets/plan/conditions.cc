#include "datasets/plan/conditions.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/base/text/text.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/rehearsed_grasps.h"

namespace graspbench {

namespace {

constexpr size_t kMostConditions = 10000;

/** A level of each factor, by its place; all 0: the base. */
using Point = std::vector<size_t>;

SweepFactor ParseFactor(const std::string& text, const SessionConfig& config) {
  const size_t sign = text.find('=');
  if (sign == text.npos || sign == 0) {
    throw Error(
        ErrorKind::kUsage,
        "--factor \"" + text + "\": expected KEY=VALUE,VALUE,.. for example model.mass_scale=1,2");
  }
  SweepFactor factor;
  for (size_t start = sign + 1; start <= text.size();) {
    const size_t comma = std::min(text.find(',', start), text.size());
    const std::string setting =
        NormaliseSetting(text.substr(0, sign + 1) + text.substr(start, comma - start), config);
    const size_t middle = setting.find('=');
    factor.key = setting.substr(0, middle);
    const std::string level = setting.substr(middle + 1);
    if (std::count(factor.levels.begin(), factor.levels.end(), level) > 0) {
      throw Error(ErrorKind::kUsage,
                  "--factor " + text + ": the level " + level + " is given twice; leave one out");
    }
    factor.levels.push_back(level);
    start = comma + 1;
  }
  if (factor.levels.size() < 2) {
    throw Error(
        ErrorKind::kUsage,
        "--factor " + text +
            ": expected two levels or more, base level first; set a single value with --set " +
            text);
  }
  return factor;
}

std::vector<SweepFactor> ParseFactors(const SweepConfig& sweep) {
  if (sweep.factors.empty()) {
    throw Error(ErrorKind::kUsage,
                "a sweep needs a factor; name one with --factor KEY=VALUE,VALUE,.. for example "
                "model.mass_scale=1,0.5,2");
  }
  std::vector<SweepFactor> factors;
  std::set<std::string> keys;
  for (const std::string& text : sweep.factors) {
    factors.push_back(ParseFactor(text, sweep));
    if (keys.insert(factors.back().key).second) continue;
    throw Error(ErrorKind::kUsage, "the factor \"" + factors.back().key +
                                       "\" is named twice; give all its levels in one list");
  }
  return factors;
}

std::vector<Point> ListFull(const std::vector<SweepFactor>& factors) {
  std::vector<Point> points = {{}};
  for (const SweepFactor& factor : factors) {
    std::vector<Point> longer;
    for (const Point& point : points) {
      for (size_t level = 0; level < factor.levels.size(); ++level) {
        longer.push_back(point);
        longer.back().push_back(level);
      }
    }
    points = std::move(longer);
    if (points.size() <= kMostConditions) continue;
    throw Error(ErrorKind::kUsage, "the full design has more than " +
                                       std::to_string(kMostConditions) +
                                       " conditions; take fewer levels, or --design latin:N");
  }
  return points;
}

std::vector<Point> ListOneAtATime(const std::vector<SweepFactor>& factors) {
  std::vector<Point> points;
  for (size_t i = 0; i < factors.size(); ++i) {
    for (size_t level = 1; level < factors[i].levels.size(); ++level) {
      points.emplace_back(factors.size(), 0);
      points.back()[i] = level;
    }
  }
  return points;
}

std::vector<Point> ListLatin(const std::vector<SweepFactor>& factors, size_t count, int seed) {
  size_t num_all = 1;
  for (const SweepFactor& factor : factors) {
    num_all = std::min(num_all * factor.levels.size(), kMostConditions + 1);
  }
  if (count >= num_all) {
    throw Error(ErrorKind::kUsage, "latin:" + std::to_string(count) + ": the factors have " +
                                       std::to_string(num_all) +
                                       " combinations in all; expected fewer, or --design full");
  }
  std::vector<Point> points(count);
  for (const SweepFactor& factor : factors) {
    std::vector<size_t> levels(count);
    for (size_t i = 0; i < count; ++i) levels[i] = i % factor.levels.size();
    RandomStream stream(std::to_string(seed), "latin hypercube " + factor.key);
    for (size_t i = count; i > 1; --i) {
      std::swap(levels[i - 1], levels[static_cast<size_t>(stream.NextIndex(static_cast<int>(i)))]);
    }
    for (size_t i = 0; i < count; ++i) points[i].push_back(levels[i]);
  }
  return points;
}

std::vector<Point> ListPoints(const SweepConfig& sweep, const std::vector<SweepFactor>& factors) {
  if (sweep.design == "full") return ListFull(factors);
  if (sweep.design == "one-at-a-time") return ListOneAtATime(factors);
  const std::string latin = "latin:";
  size_t count = 0;
  const char* const end = sweep.design.data() + sweep.design.size();
  if (sweep.design.rfind(latin, 0) == 0) {
    const auto read = std::from_chars(sweep.design.data() + latin.size(), end, count);
    if (read.ec == std::errc() && read.ptr == end && count >= 2 && count <= kMostConditions) {
      return ListLatin(factors, count, sweep.seed);
    }
  }
  throw Error(ErrorKind::kUsage, "no design \"" + sweep.design +
                                     "\"; expected full, one-at-a-time or latin:N with N from 2 "
                                     "to " +
                                     std::to_string(kMostConditions));
}

/** A factor that no trial looks at would be reported as one without effect; of one that the base
leaves out, its conditions would have the default in the place of its first level.
@param strategies  of the base and of each condition. */
void RefuseUnused(const std::vector<SweepFactor>& factors, const SessionConfig& base,
                  const std::vector<StrategyConfig>& strategies) {
  for (const SweepFactor& factor : factors) {
    const auto used = std::find_if(
        strategies.begin(), strategies.end(),
        [&](const StrategyConfig& strategy) { return CanMatter(factor.key, strategy); });
    const bool has_level = FindBaseLevel(base, factor.key) == factor.levels.front();
    if (used != strategies.end() && has_level) continue;
    const std::string& grip = strategies.front().grip;
    throw Error(
        ErrorKind::kUsage,
        "the factor \"" + factor.key + "\" has no effect if strategy.grip is " + grip +
            (used == strategies.end()
                 ? "; leave it out, or set strategy.grip"
                 : ", the base level; list the grip that uses it first: --factor strategy.grip=" +
                       used->grip + "," + grip));
  }
}

/** Trials that are those of another condition would halve the effect of a factor. */
void RefuseRepeated(const SweepFactor& factor, const StrategyConfig& strategy,
                    const Condition& condition) {
  if (CanMatter(factor.key, strategy)) return;
  throw Error(ErrorKind::kUsage, "the factor \"" + factor.key +
                                     "\" has no effect under the condition \"" + condition.name +
                                     "\", whose trials would not change; use --design "
                                     "one-at-a-time, or sweep each grip separately");
}

constexpr double kLongestDelay = 10.0;  // [s]

/** Keys of conditions that are none of a session. */
constexpr const char* kGrasp = "grasp";
constexpr const char* kLast = "delay.last";
constexpr const char* kFirst = "delay.first";
constexpr const char* kBackend = "backend";
constexpr const char* kImplicit = "implicit";
constexpr const char* kCompliant = "compliant";
constexpr const char* kBest = "best";
constexpr const char* kAgain = "again";

/** What leaves the draws of a trial, as key or as group of keys. */
const std::vector<std::string> kComparable = {"variation",     "strategy",    "sim",    "model",
                                              "imperfections", "positioning", "camera", "touch",
                                              "sensors",       "approach",    "policy", "arm"};

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
  } else if (setting.key == kBest) {
    if (setting.value != kAgain) {
      throw Error(ErrorKind::kUsage, "best=" + setting.value + ": expected again");
    }
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

SweepConfig ParseSweepConfig(const std::string& text, const std::string& file) {
  Diagnostics problems;
  SweepConfig config;
  const YAML::Node root = ParseYaml(text, file, problems);
  ReadConfig(root, file, "sweep", config, problems);
  for (const ConfigProblem& problem : Validate(config)) {
    problems.Fail(file, FindConfigLine(root, problem.key), problem.key + ": " + problem.text);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the sweep cannot be run");
  return config;
}

SweepConfig LoadSweepConfig(const std::string& path) {
  return ParseSweepConfig(ReadFile(path), path);
}

const FileKeys& ListSweepKeys() {
  static const FileKeys keys = DescribeConfig(SweepConfig());
  return keys;
}

SessionConfig MakeSweep(const SweepConfig& sweep) {
  const std::vector<SweepFactor> factors = ParseFactors(sweep);
  Condition base;
  for (const SweepFactor& factor : factors) {
    base.settings.push_back(factor.key + "=" + factor.levels.front());
  }
  const ConditionInputs made = ApplyCondition(base, sweep);
  if (made.late != LateDigit::kNone || made.is_compliant) {
    throw Error(
        ErrorKind::kUsage,
        "the first (base) level of delay.last and delay.first must be 0, that of backend implicit");
  }
  SessionConfig config = made.config;
  std::vector<StrategyConfig> strategies = {config.strategy};
  std::set<Point> known = {Point(factors.size(), 0)};
  std::vector<Point> points;  // of the conditions
  for (const Point& point : ListPoints(sweep, factors)) {
    if (!known.insert(point).second) continue;
    points.push_back(point);
    Condition condition;
    for (size_t i = 0; i < factors.size(); ++i) {
      if (point[i] == 0) continue;
      condition.settings.push_back(factors[i].key + "=" + factors[i].levels[point[i]]);
      condition.name += (condition.name.empty() ? "" : ", ") + condition.settings.back();
    }
    // What cannot be combined is refused here.
    strategies.push_back(ApplyCondition(condition, made.config).config.strategy);
    config.conditions.push_back(condition);
  }
  if (sweep.grasp_per_condition) config.conditions = ChooseAgain(config.conditions, config);
  RefuseUnused(factors, made.config, strategies);
  for (size_t k = 0; k < points.size(); ++k) {
    for (size_t i = 0; i < factors.size(); ++i) {
      if (points[k][i] != 0) RefuseRepeated(factors[i], strategies[k + 1], config.conditions[k]);
    }
  }
  return config;
}

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
    throw Error(
        ErrorKind::kUsage,
        "\"" + key +
            "\" changes the plan; only settings that keep the draws can be compared pair by pair: "
            "variation.*, strategy.*, sim.*, model.*, imperfections.*, positioning, camera.*, "
            "arm.*, touch, sensors.*, approach, grasp, delay.last, delay.first, backend");
  }
  if ((group == "camera" || group == "sensors") && !ToJson(changed).contains(group)) {
    throw Error(ErrorKind::kUsage,
                "\"" + key + "\" has no effect here: the session has " +
                    (group == "camera" ? "positioning: " + config.positioning + ", not camera"
                                       : "touch: " + config.touch + ", not sensed"));
  }
  if (group == "arm" && key != "arm.model" && !HasArm(changed.arm)) {
    throw Error(ErrorKind::kUsage,
                "\"" + key + "\" has no effect here: arm.model is none; set arm.model, too");
  }
  const std::string level = FindBaseLevel(changed, key);
  if (level != FindBaseLevel(config, key) && ToJson(changed) == ToJson(config)) {
    throw Error(ErrorKind::kUsage, "\"" + key + "=" + level +
                                       "\" has no effect here with the session's other settings");
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
  if (!made.config.policy.command.empty() && (made.late != LateDigit::kNone || made.is_compliant)) {
    throw Error(ErrorKind::kUsage, "the condition \"" + condition.name +
                                       "\" delays a digit or changes the backend, and "
                                       "policy.command gives the digits to a controller; leave one "
                                       "of them out");
  }
  if (made.is_compliant && HasArm(made.config.arm)) {
    throw Error(ErrorKind::kUnsupported,
                "the condition \"" + condition.name + "\" has arm.model " + made.config.arm.model +
                    " and the compliant backend, which has no robot arm; leave one of them out");
  }
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

bool ChoosesGraspAgain(const Condition& condition) {
  return std::any_of(condition.settings.begin(), condition.settings.end(),
                     [](const std::string& text) { return Split(text).key == kBest; });
}

std::vector<Condition> ChooseAgain(std::vector<Condition> conditions, const SessionConfig& config) {
  bool has_choice =
      std::any_of(config.grasps.begin(), config.grasps.end(), [](const std::string& name) {
        return name == kBestGrasp || name == kPredictedGrasp || ParseRehearsed(name);
      });
  for (Condition& condition : conditions) {
    for (const std::string& text : condition.settings) {
      has_choice = has_choice && Split(text).key != kGrasp;
    }
    condition.settings.push_back(std::string(kBest) + "=" + kAgain);
  }
  if (has_choice) return conditions;
  throw Error(ErrorKind::kUsage,
              "--grasp-per-condition needs chosen grasps, but the grasps are named; leave it out, "
              "or use --grasp best, predicted or rehearsed without the factor grasp");
}

std::vector<SweepFactor> ListFactors(const SessionConfig& config) {
  std::vector<SweepFactor> factors;
  for (const Condition& condition : config.conditions) {
    for (const std::string& text : condition.settings) {
      const Assignment setting = Split(text);
      if (setting.key == kBest) continue;  // says how, not what
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
