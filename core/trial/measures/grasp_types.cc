#include "core/trial/measures/grasp_types.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr double kLeastAsCalled = 0.5;  // share of the held objects with the type's opposition

}  // namespace

const std::vector<GraspTypeRule>& ListGraspTypeRules() {
  static const std::vector<GraspTypeRule> rules = {
      {"g1", TypeDigits::kAll, Opposition::kPad, "pads of all digits", 10, 85, ""},
      {"g2", TypeDigits::kThumbAndIndex, Opposition::kPad, "pads of thumb and index", 0, 60, ""},
      {"g3", TypeDigits::kAll, Opposition::kPalm, "palm, links of all digits", 40, 85, ""},
      {"g4", TypeDigits::kAnyTwo, Opposition::kSide,
       "thumb's pad and a finger's side, or sides of two neighbours", 0, 30, ""},
      {"g5", TypeDigits::kAnyThree, Opposition::kPad, "pads of three digits", 0, 100,
       "toy_propeller"},
      {"g6", TypeDigits::kAll, Opposition::kPad, "links of all digits", 40, 115, ""},
  };
  return rules;
}

const GraspTypeRule* FindGraspTypeRule(const std::string& grasp) {
  for (const GraspTypeRule& rule : ListGraspTypeRules()) {
    if (rule.grasp == grasp) return &rule;
  }
  return nullptr;
}

const char* NameOf(TypeDigits digits) {
  switch (digits) {
    case TypeDigits::kAll:
      return "all digits";
    case TypeDigits::kThumbAndIndex:
      return "thumb and index";
    case TypeDigits::kAnyTwo:
      return "two digits";
    case TypeDigits::kAnyThree:
      return "three digits";
  }
  return "";
}

std::string FindIndexFinger(const Hand& hand) {
  for (const Digit& digit : hand.digits) {
    if (digit.name == "index") return digit.id;
  }
  for (const Digit& digit : hand.digits) {
    if (!digit.is_thumb) return digit.id;
  }
  return "";
}

std::vector<std::string> ListTypeFaults(const Hand& hand, const Grasp& grasp) {
  const GraspTypeRule* rule = FindGraspTypeRule(grasp.id);
  if (!rule) return {};
  std::string found;
  bool has_thumb = false, has_index = false;
  for (const std::string& id : grasp.digits) {
    found += (found.empty() ? "" : ", ") + id;
    has_index = has_index || id == FindIndexFinger(hand);
    has_thumb = has_thumb || std::any_of(hand.digits.begin(), hand.digits.end(),
                                         [&](const auto& d) { return d.id == id && d.is_thumb; });
  }
  const size_t count = grasp.digits.size();
  const bool is_right = rule->digits == TypeDigits::kAll      ? count == hand.digits.size()
                        : rule->digits == TypeDigits::kAnyTwo ? count == 2
                        : rule->digits == TypeDigits::kAnyThree
                            ? count == 3
                            : count == 2 && has_thumb && has_index;
  std::vector<std::string> faults;
  const std::string name = FindGraspTaxon(grasp.id).name;
  if (!is_right) {
    faults.push_back(fmt::format(
        "grasp {} takes with {}; {} takes with {} (graspbench hand develop finds such a grasp)",
        grasp.id, found, name, NameOf(rule->digits)));
  }
  if (grasp.as_called_share < kLeastAsCalled) {
    faults.push_back(fmt::format(
        "grasp {} is called {}, but {:.0f} % of what it held in its development shows {} "
        "opposition; half would make it one",
        grasp.id, name, 100.0 * grasp.as_called_share, RowOf(kOppositions, rule->opposition).name));
  }
  return faults;
}

bool IsGraspFor(const Grasp& grasp, const GraspObject& object) {
  const GraspTypeRule* rule = FindGraspTypeRule(grasp.id);
  if (!rule) return true;
  const double width_mm = MmFromM(object.size.y());
  return !grasp.seeks_palm || (width_mm >= rule->least_width_mm && width_mm <= rule->most_width_mm);
}

bool IsAsCalled(const std::string& grasp, const TrialResult& result) {
  const GraspTypeRule* rule = FindGraspTypeRule(grasp);
  if (!rule || !result.opposition || *result.opposition != rule->opposition) return false;
  return rule->opposition != Opposition::kPad ||
         std::none_of(result.contacts.begin(), result.contacts.end(),
                      [](const DigitContact& contact) { return std::isnan(contact.time); });
}

}  // namespace graspbench
