#include "human_study/study/trial_removal.h"

#include <algorithm>
#include <map>
#include <utility>

#include "human_study/study/run_study.h"

namespace graspbench {

Removal FindRemoval(const TrialAnalysis& analysis, const RemovalConfig& rules) {
  const auto doubt = [&](const std::vector<Doubt>& doubts) -> Removal {
    if (!rules.implausible || doubts.empty()) return {};
    return {doubts.front().code, doubts.front().text};
  };
  // What is wrong with the trial as such explains why events are missing.
  if (Removal removal = doubt(analysis.trial_doubts); !removal.text.empty()) return removal;
  if (!analysis.movement.onset.IsFound()) {
    return {"no_onset", "no onset of the movement: " + analysis.movement.onset.missing};
  }
  if (!analysis.hold.IsFound()) return {"no_hold", "no hold: " + analysis.hold.missing};
  if (!analysis.closure_start.IsFound()) {
    return {"no_opening", "no widest opening: " + analysis.closure_start.missing};
  }
  Removal missing_finger;
  int num_fingers = 0;
  for (const DigitContactEvents& digit : analysis.contacts) {
    const std::string name = NameOfDigit(digit.digit);
    if (digit.contact.IsFound()) {
      if (!digit.is_thumb) ++num_fingers;
      if (rules.max_disagreement > 0.0 && !digit.is_reviewed &&
          digit.disagreement > rules.max_disagreement) {
        return {"disagreement", "detectors disagree on the contact of the " + name};
      }
      continue;
    }
    const bool is_usable = !IsUntold(digit.contact);
    const Removal removal = {is_usable ? "no_contact" : "not_usable",
                             "no contact of the " + name + ": " + digit.contact.missing};
    if (digit.is_thumb || rules.missing_digit) return removal;
    missing_finger = removal;
  }
  if (num_fingers == 0) return missing_finger;
  if (rules.filled_event && analysis.used_filled) {
    return {"filled_event", "an event was decided on filled samples"};
  }
  if (rules.gap_event && analysis.used_gap) return {"gap_event", "an event fell into a gap"};
  return doubt(analysis.doubts);
}

std::string HideNumbers(const std::string& text) {
  std::string hidden;
  bool is_number = false;
  for (const char c : text) {
    const bool is_digit = c >= '0' && c <= '9';
    if (is_digit && !is_number) hidden += "\u2026";
    is_number = is_digit || (is_number && c == '.');
    if (!is_number) hidden += c;
  }
  return hidden;
}

std::vector<RemovalGroup> GroupRemoved(const std::vector<StudyTrial>& trials) {
  std::vector<RemovalGroup> groups;
  for (const StudyTrial& trial : trials) {
    if (trial.IsKept()) continue;
    const std::string kind = HideNumbers(trial.removed);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& g) { return HideNumbers(g.text) == kind; });
    if (group == groups.end()) {
      group = groups.insert(groups.end(), {trial.removed_code, trial.removed, {}});
    } else if (group->text != trial.removed) {
      group->text = kind;
    }
    group->trials.push_back(trial.id);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.trials.size() > b.trials.size(); });
  return groups;
}

std::vector<FindingGroup> GroupFindings(const StudyResult& result) {
  std::vector<FindingGroup> groups;
  std::map<std::pair<std::string, std::string>, size_t> places;  // by code and hidden text
  for (const FileFinding& entry : result.findings) {
    const ImportFinding& finding = entry.finding;
    const auto key = std::pair(finding.code, HideNumbers(finding.text));
    const auto [place, is_new] = places.try_emplace(key, groups.size());
    if (is_new) groups.push_back({finding.code, finding.text, 0, {}});
    FindingGroup& group = groups[place->second];
    if (group.text != finding.text) group.text = key.second;
    ++group.count;
    if (group.files.empty() || group.files.back() != entry.file) group.files.push_back(entry.file);
  }
  return groups;
}

}  // namespace graspbench
