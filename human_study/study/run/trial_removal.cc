#include "human_study/study/run/trial_removal.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/base/text/delimited_text.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

/** A number of a sentence, or what stands between two. */
struct Piece {
  std::string text;
  bool is_number = false;
  double value = 0.0;
};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/** Behind "e-05", if that is there. */
size_t SkipExponent(const std::string& text, size_t at) {
  if (at >= text.size() || text[at] != 'e') return at;
  size_t end = at + 1;
  if (end < text.size() && (text[end] == '-' || text[end] == '+')) ++end;
  if (end >= text.size() || !IsDigit(text[end])) return at;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return end;
}

/** Numbers stand by themselves; digits within a name are an ellipsis. */
std::vector<Piece> SplitNumbers(const std::string& text) {
  std::vector<Piece> pieces = {{}};
  for (size_t at = 0; at < text.size();) {
    if (!IsDigit(text[at])) {
      pieces.back().text += text[at++];
      continue;
    }
    size_t end = at;
    while (end < text.size() && (IsDigit(text[end]) || text[end] == '.')) ++end;
    if (text[end - 1] == '.') --end;  // of the sentence
    end = SkipExponent(text, end);
    const bool is_open = at == 0 || std::string(" (=").find(text[at - 1]) != std::string::npos;
    const bool is_closed =
        end == text.size() || std::string(" ,;:.)%").find(text[end]) != std::string::npos;
    const std::string number = text.substr(at, end - at);
    const std::optional<double> value = ParseFiniteNumber(number);
    if (is_open && is_closed && value) {
      pieces.push_back({number, true, *value});
      pieces.push_back({});
    } else {
      pieces.back().text += "\u2026";
    }
    at = end;
  }
  return pieces;
}

/** The text without its numbers: equal for texts that differ in them alone. */
std::string KindOf(const std::string& text) {
  std::string kind;
  for (const Piece& piece : SplitNumbers(text)) kind += piece.is_number ? "\u2026" : piece.text;
  return kind;
}

}  // namespace

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
    const bool is_usable = !IsUnresolved(digit.contact);
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

std::string MergeNumbers(const std::vector<std::string>& texts) {
  const auto differs = [&](const std::string& text) { return text != texts.front(); };
  if (std::none_of(texts.begin(), texts.end(), differs)) return texts.front();
  const std::vector<Piece> first = SplitNumbers(texts.front());
  std::vector<Piece> low = first, high = first;
  for (const std::string& text : texts) {
    const std::vector<Piece> pieces = SplitNumbers(text);
    for (size_t i = 0; i < first.size(); ++i) {
      if (!first[i].is_number) continue;
      if (pieces[i].value < low[i].value) low[i] = pieces[i];
      if (pieces[i].value > high[i].value) high[i] = pieces[i];
    }
  }
  std::string merged;
  for (size_t i = 0; i < first.size(); ++i) {
    merged += low[i].text;
    if (low[i].text != high[i].text) merged += ".." + high[i].text;
  }
  return merged;
}

std::vector<RemovalGroup> GroupRemoved(const std::vector<StudyTrial>& trials) {
  std::vector<RemovalGroup> groups;
  std::vector<std::vector<std::string>> texts;
  std::map<std::string, size_t> places;  // by kind
  for (const StudyTrial& trial : trials) {
    if (trial.IsKept()) continue;
    const auto [place, is_new] = places.try_emplace(KindOf(trial.removed), groups.size());
    if (is_new) {
      groups.push_back({trial.removed_code, "", {}});
      texts.emplace_back();
    }
    groups[place->second].trials.push_back(trial.id);
    texts[place->second].push_back(trial.removed);
  }
  for (size_t i = 0; i < groups.size(); ++i) groups[i].text = MergeNumbers(texts[i]);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.trials.size() > b.trials.size(); });
  return groups;
}

std::vector<FindingGroup> GroupFindings(const StudyResult& result) {
  std::vector<FindingGroup> groups;
  std::vector<std::vector<std::string>> texts;
  std::map<std::pair<std::string, std::string>, size_t> places;  // by code and kind
  for (const FileFinding& entry : result.findings) {
    const ImportFinding& finding = entry.finding;
    const auto key = std::pair(finding.code, KindOf(finding.text));
    const auto [place, is_new] = places.try_emplace(key, groups.size());
    if (is_new) {
      groups.push_back({finding.code, "", 0, {}});
      texts.emplace_back();
    }
    FindingGroup& group = groups[place->second];
    texts[place->second].push_back(finding.text);
    ++group.count;
    if (group.files.empty() || group.files.back() != entry.file) group.files.push_back(entry.file);
  }
  for (size_t i = 0; i < groups.size(); ++i) groups[i].text = MergeNumbers(texts[i]);
  return groups;
}

}  // namespace graspbench
