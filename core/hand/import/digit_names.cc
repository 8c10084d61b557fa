#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <vector>

#include "core/base/text/text.h"
#include "core/hand/closing.h"
#include "core/hand/import/guess_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Digit that the name of a link or joint suggests: "TH", "FF", ...; empty: none. */
std::string FindNamedDigit(const std::string& name) {
  const std::string text = ToLower(name);
  const std::vector<std::pair<const char*, const char*>> words = {
      {"thumb", "TH"},   {"daumen", "TH"},        {"index", "FF"},        {"forefinger", "FF"},
      {"pointer", "FF"}, {"middle_finger", "MF"}, {"middlefinger", "MF"}, {"ring", "RF"},
      {"little", "LF"},  {"pinky", "LF"},         {"pinkie", "LF"},       {"middle", "MF"}};
  for (const auto& [word, id] : words) {
    const size_t at = text.find(word);
    if (at == std::string::npos) continue;
    const bool is_in_word = at > 0 && std::isalpha(static_cast<unsigned char>(text[at - 1])) &&
                            std::string(word) == "ring";  // "spring", "string"
    if (!is_in_word) return id;
  }
  // Names of the Shadow Hand: rh_ffdistal, lh_THJ1.
  for (const char* prefix : {"", "rh_", "lh_", "r_", "l_", "right_", "left_"}) {
    if (text.compare(0, std::string(prefix).size(), prefix) != 0) continue;
    const std::string rest = text.substr(std::string(prefix).size());
    for (const char* id : {"th", "ff", "mf", "rf", "lf"}) {
      const bool goes_on = rest.size() > 2 && (rest[2] == 'j' || rest[2] == '_' || rest[2] == 'd' ||
                                               rest[2] == 't' || rest[2] == 'p');
      if (rest.compare(0, 2, id) != 0 || (rest.size() > 2 && !goes_on)) continue;
      std::string upper = id;
      for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      return upper;
    }
  }
  return "";
}

}  // namespace

void NameByVotes(Hand& hand) {
  std::map<std::string, int> most_votes, num_equals;
  std::vector<int> votes_of(hand.digits.size(), 0);
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    Digit& digit = hand.digits[d];
    std::map<std::string, int> votes;
    for (const int link : digit.links) {
      ++votes[FindNamedDigit(hand.links[link].name)];
      const int joint = hand.links[link].joint;
      if (joint >= 0) ++votes[FindNamedDigit(hand.joints[joint].name)];
    }
    votes.erase("");
    for (const auto& [id, count] : votes) {
      if (count > votes_of[d]) digit.id = id;
      votes_of[d] = std::max(votes_of[d], count);
    }
    int& most = most_votes[digit.id];
    num_equals[digit.id] = votes_of[d] > most ? 1 : num_equals[digit.id] + (votes_of[d] == most);
    most = std::max(most, votes_of[d]);
  }
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    std::string& id = hand.digits[d].id;
    if (votes_of[d] < most_votes[id] || num_equals[id] > 1) id.clear();
  }
}

void NameDigits(Hand& hand) {
  const std::vector<std::pair<std::string, std::string>> kNames = {
      {"FF", "index"}, {"MF", "middle"}, {"RF", "ring"}, {"LF", "little"}};
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  std::set<std::string> taken;
  std::vector<size_t> unnamed;
  Vector3d p_HThumb = Vector3d::Zero();
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    Digit& digit = hand.digits[d];
    if (digit.is_thumb) {
      p_HThumb = X_HL[digit.distal_link] * digit.p_LTip;
      digit.name = "thumb";
    } else if (digit.id.empty() || !taken.insert(digit.id).second) {
      unnamed.push_back(d);
    }
  }
  // From the thumb's side, as in a human hand.
  const auto distance = [&](size_t d) {
    return (X_HL[hand.digits[d].links.front()].translation() - p_HThumb).norm();
  };
  std::stable_sort(unnamed.begin(), unnamed.end(),
                   [&](size_t a, size_t b) { return distance(a) < distance(b) - 1e-6; });
  int number = 0;
  for (const size_t d : unnamed) {
    Digit& digit = hand.digits[d];
    digit.id.clear();
    for (const auto& [id, name] : kNames) {
      if (digit.id.empty() && taken.insert(id).second) digit.id = id;
    }
    while (digit.id.empty()) {
      const std::string id = "D" + std::to_string(++number);
      if (taken.insert(id).second) digit.id = id;
    }
  }
  for (Digit& digit : hand.digits) {
    for (const auto& [id, name] : kNames) {
      if (digit.id == id) digit.name = name;
    }
    if (digit.name.empty()) digit.name = "digit " + digit.id.substr(1);
  }
  // In the order of a hand, the thumb last.
  const auto rank = [&](const Digit& digit) {
    for (size_t i = 0; i < kNames.size(); ++i) {
      if (digit.id == kNames[i].first) return i;
    }
    return digit.is_thumb ? kNames.size() + 1 : kNames.size();
  };
  std::stable_sort(hand.digits.begin(), hand.digits.end(),
                   [&](const Digit& a, const Digit& b) { return rank(a) < rank(b); });
}

}  // namespace graspbench
