#include "human_study/study/design/study_config.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "core/base/config.h"
#include "core/base/text/yaml.h"

namespace graspbench {
namespace {

constexpr double kLeastNear = 1e-3;  // [m]

constexpr const char* kDigitIds[] = {"TH", "FF", "MF", "RF", "LF"};
constexpr const char* kDigitNames[] = {"thumb", "index", "middle", "ring", "little"};

bool IsLabel(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 128 && std::isalnum(c) != 0;
  });
}

/** Problems of values, each at the line of its key. */
class ConfigChecker {
 public:
  ConfigChecker(const YAML::Node& root, const std::string& file, Diagnostics& problems)
      : root_(root), file_(file), problems_(&problems) {}

  void Fail(const std::string& key, const std::string& text) {
    problems_->Fail(file_, FindConfigLine(root_, key), key + ": " + text);
  }
  void CheckName(const std::string& key, const std::string& name,
                 const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    Fail(key, "\"" + name + "\" is not known" + SuggestNames(name, known));
  }
  template <class List>
  static std::vector<std::string> ListIds(const List& list) {
    std::vector<std::string> ids;
    for (const auto& entry : list) ids.push_back(entry.id);
    return ids;
  }

 private:
  YAML::Node root_;
  std::string file_;
  Diagnostics* problems_;
};

void CheckMarkers(const StudyConfig& config, ConfigChecker& check) {
  int num_tips = 0;
  std::map<std::string, std::string> roles;
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    const std::string key = std::string("markers.") + NameOfDigit(digit);
    if (!config.markers.tips[digit].empty()) ++num_tips;
    for (const std::string& label : config.markers.tips[digit]) {
      const auto [role, is_new] = roles.insert({label, key});
      if (!is_new) check.Fail(key, "\"" + label + "\" is already " + role->second);
    }
    const std::vector<std::string>& joints = config.markers.joints[digit];
    const std::string of_joints = std::string("markers.joints.") + NameOfDigit(digit);
    if (joints.size() == 1) {
      check.Fail(of_joints,
                 "expected two joints or more, from the palm to the last before the tip");
    }
    if (!joints.empty() && config.markers.tips[digit].empty()) {
      check.Fail(of_joints, "the digit has no tip; name its label as " + key);
    }
  }
  if (num_tips < 2 || config.markers.tips.thumb.empty()) {
    check.Fail("markers",
               "name the marker of the thumb's tip and of at least one other digit, for instance "
               "{thumb: thumb_tip, index: index_tip}; a single marker (aiming) tells when a hand "
               "moves, not when digits touch, and is not analysed here");
  }
}

void CheckMultiverse(const StudyConfig& config, ConfigChecker& check) {
  const MultiverseConfig& multiverse = config.multiverse;
  const auto check_names = [&](const char* key, const std::vector<std::string>& names,
                               const std::vector<std::string>& known) {
    for (const std::string& name : names) check.CheckName(key, name, known);
  };
  check_names("multiverse.measure", {multiverse.measure},
              ConfigChecker::ListIds(TrialMeasureList()));
  check_names("multiverse.onset", multiverse.onset, ConfigChecker::ListIds(MovementRuleList()));
  check_names("multiverse.detector", multiverse.detector,
              ConfigChecker::ListIds(ContactDetectorList()));
  check_names("multiverse.opening", multiverse.opening, ConfigChecker::ListIds(HandOpeningList()));
}

/** @param are_numbers_good  else there is nothing more to say of them. */
void CheckAnalysis(const AnalysisOptions& options, bool are_numbers_good, ConfigChecker& check) {
  check.CheckName("movement.rule", options.movement.rule,
                  ConfigChecker::ListIds(MovementRuleList()));
  check.CheckName("lift_off.rule", options.lift_off.rule,
                  ConfigChecker::ListIds(LiftOffRuleList()));
  check.CheckName("opening.measure", options.opening.measure,
                  ConfigChecker::ListIds(HandOpeningList()));
  check.CheckName("opening.maximum", options.opening.maximum, {"largest", "last"});
  std::vector<std::string> detectors = ConfigChecker::ListIds(ContactDetectorList());
  detectors.push_back(kAutomaticDetector);
  check.CheckName("contact.detector", options.contact.detector, detectors);
  if (!are_numbers_good) return;
  try {
    AnalysisOptions settled = options;
    if (settled.contact.detector == kAutomaticDetector)
      settled.contact.detector = ContactOptions().detector;
    CheckOptions(settled);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kNotFound) return;  // reported above, with its line
    // "contact.cutoff_hz is -1; expected ..": the message starts with the key.
    const std::string text = error.what();
    const size_t space = text.find(' ');
    check.Fail(text.substr(0, space), text.substr(std::min(space, text.size() - 1) + 1));
  }
}

/** Columns of trials.csv that the design is made of. */
void CheckColumns(const StudyConfig& config, ConfigChecker& check) {
  std::set<std::string> columns;
  const auto add = [&](const char* key, const std::string& column) {
    if (!columns.insert(column).second) check.Fail(key, "\"" + column + "\" is listed twice");
    // The name becomes a heading of every table.
    if (column.find_first_of("=+-@") == 0) {
      check.Fail(key, "\"" + column +
                          "\" begins like a formula, which spreadsheets would run; rename the "
                          "column");
    }
  };
  for (const std::string& factor : config.factors) add("factors", factor);
  for (const std::string& group : config.groups) add("groups", group);
  // A session may be a factor, too.
  const bool is_factor = std::find(config.factors.begin(), config.factors.end(), config.session) !=
                         config.factors.end();
  if (!config.session.empty() && !is_factor) add("session", config.session);
}

void CheckConfig(const StudyConfig& config, ConfigChecker& check) {
  if (!IsLabel(config.task)) {
    check.Fail("task", "\"" + config.task + "\"; expected letters and digits alone");
  }
  if (config.trials.empty()) check.Fail("trials", "expected the name of a table");
  CheckColumns(config, check);
  CheckMarkers(config, check);
  for (const std::string& measure : config.measures) {
    check.CheckName("measures", measure, ConfigChecker::ListIds(TrialMeasureList()));
  }
  if (config.cut.near != 0.0 || config.cut.far != 0.0) {
    if (config.cut.near < kLeastNear) check.Fail("cut.near_m", "expected 0, or at least 0.001 m");
    if (!(config.cut.far > config.cut.near)) {
      check.Fail("cut.far_m", "must be larger than cut.near_m");
    }
    if (config.markers.object.empty()) {
      check.Fail("cut", "cutting needs the object's markers: markers.object is empty");
    }
  }
  const auto out_of_range = FindOutOfRange(config, ListStudyKeys());
  for (const auto& [key, text] : out_of_range) check.Fail(key, text);
  CheckMultiverse(config, check);
  CheckAnalysis(config.analysis, out_of_range.empty(), check);
}

/** Keys of the cut-offs that the document or a setting ("contact.cutoff_hz=12") gives. */
std::set<std::string> FindStatedCutoffs(const YAML::Node& root,
                                        const std::vector<std::string>& settings) {
  std::set<std::string> stated;
  const auto look_for = [&](const std::string& key) {
    const auto sets_it = [&](const std::string& setting) {
      const size_t first = setting.find_first_not_of(" \t");
      return first != std::string::npos && setting.compare(first, key.size(), key) == 0 &&
             setting.find_first_not_of(" \t", first + key.size()) == setting.find('=');
    };
    if (FindConfigLine(root, key) > 0 || std::any_of(settings.begin(), settings.end(), sets_it)) {
      stated.insert(key);
    }
  };
  for (const auto& [key, cutoff] : ListCutoffs(AnalysisOptions())) look_for(key);
  look_for(kMultiverseCutoff);
  return stated;
}

}  // namespace

const char* IdOfDigit(int digit) { return kDigitIds[digit]; }
const char* NameOfDigit(int digit) { return kDigitNames[digit]; }

std::string NameOfDigit(const std::string& id) {
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    if (id == kDigitIds[digit]) return kDigitNames[digit];
  }
  return id;
}

const FileKeys& ListStudyKeys() {
  static const FileKeys keys = DescribeConfig(StudyConfig());
  return keys;
}

MarkerConfig MarkersOfHand(const MarkerConfig& markers, const std::string& hand) {
  const auto replace = [&](std::string& label) {
    const std::string name = kHandInLabels;
    for (size_t at = label.find(name); at != std::string::npos;
         at = label.find(name, at + hand.size())) {
      label.replace(at, name.size(), hand);
    }
  };
  MarkerConfig own = markers;
  const auto replace_all = [&](const char*, std::vector<std::string>& labels, const KeyInfo& = {}) {
    for (std::string& label : labels) replace(label);
  };
  own.tips.Visit(replace_all);
  replace_all("", own.wrist);
  replace_all("", own.object);
  own.companions.Visit(
      [&](const char*, std::string& label, const KeyInfo& = {}) { replace(label); });
  own.joints.Visit(replace_all);
  return own;
}

StudyConfig ParseStudyConfig(const std::string& text, const std::string& file,
                             Diagnostics& problems, const std::vector<std::string>& settings) {
  StudyConfig config;
  config.analysis.contact.detector = kAutomaticDetector;
  const YAML::Node root = ParseYaml(text, file, problems);
  if (problems.num_errors() > 0) return config;
  ReadConfig(root, file, "study", config, problems);
  if (problems.num_errors() > 0) return config;  // defaults would give misleading follow-ups
  for (const std::string& setting : settings) SetConfigValue(setting, config);
  config.analysis.stated_cutoffs = FindStatedCutoffs(root, settings);
  ConfigChecker check(root, file, problems);
  CheckConfig(config, check);
  return config;
}

StudyConfig FitCutoffs(StudyConfig config, double rate) {
  for (double& cutoff : config.multiverse.cutoff) {
    cutoff = FitCutoff(config.analysis, kMultiverseCutoff, cutoff, rate);
  }
  config.analysis = FitCutoffs(config.analysis, rate);
  return config;
}

std::string FindCutoffFault(const StudyConfig& config, double rate) {
  const StudyConfig fitted = FitCutoffs(config, rate);
  Cutoffs cutoffs = ListCutoffs(fitted.analysis);
  const std::vector<double>& others = fitted.multiverse.cutoff;
  if (!others.empty()) {
    cutoffs.emplace_back(kMultiverseCutoff, *std::max_element(others.begin(), others.end()));
  }
  return FindCutoffFault(cutoffs, rate);
}

std::vector<std::string> LowerStatedCutoffs(const StudyConfig& config, double rate) {
  StudyConfig free = config;
  free.analysis.stated_cutoffs.clear();
  const Cutoffs stated = ListCutoffs(config.analysis);
  const Cutoffs lowered = ListCutoffs(FitCutoffs(free.analysis, rate));
  const auto does_not_fit = [&](double cutoff) {
    return !FindCutoffFault(Cutoffs{{"", cutoff}}, rate).empty();
  };
  std::vector<std::string> settings;
  for (size_t i = 0; i < stated.size(); ++i) {
    if (config.analysis.stated_cutoffs.count(stated[i].first) == 0) continue;
    if (!does_not_fit(stated[i].second)) continue;
    settings.push_back(fmt::format("{}={:.3g}", stated[i].first, lowered[i].second));
  }
  const std::vector<double>& others = config.multiverse.cutoff;
  if (config.analysis.stated_cutoffs.count(kMultiverseCutoff) > 0 &&
      std::any_of(others.begin(), others.end(), does_not_fit)) {
    std::string list;
    for (const double cutoff : FitCutoffs(free, rate).multiverse.cutoff) {
      list += fmt::format("{}{:.3g}", list.empty() ? "" : ", ", cutoff);
    }
    settings.push_back(fmt::format("{}=[{}]", kMultiverseCutoff, list));
  }
  return settings;
}

}  // namespace graspbench
