#include "human_study/study/design/study_cutoffs.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/config.h"

namespace graspbench {

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
