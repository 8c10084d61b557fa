#include "human_study/measures/contact_order.h"

#include <algorithm>
#include <cmath>

namespace graspbench {

ContactOrder FindContactOrder(const std::vector<DigitContactEvents>& contacts) {
  constexpr double kTieFactor = 1.96;  // 95 % of a normal distribution
  ContactOrder order;
  std::vector<const DigitContactEvents*> touching;
  for (const DigitContactEvents& contact : contacts) {
    if (contact.contact.IsFound()) {
      touching.push_back(&contact);
    } else {
      order.missing.push_back(contact.digit);
    }
  }
  std::stable_sort(touching.begin(), touching.end(),
                   [](const auto* a, const auto* b) { return a->contact.time < b->contact.time; });
  for (size_t i = 0; i < touching.size(); ++i) {
    bool is_tied = false;
    if (i > 0) {
      const EventTime &a = touching[i - 1]->contact, &b = touching[i]->contact;
      is_tied = b.time - a.time < kTieFactor * std::hypot(a.uncertainty, b.uncertainty);
    }
    order.num_ties += is_tied;
    if (!is_tied) order.groups.emplace_back();
    order.groups.back().push_back(touching[i]->digit);
  }
  return order;
}

std::string ContactOrder::Format() const {
  std::string text;
  for (const std::vector<std::string>& group : groups) {
    if (!text.empty()) text += "<";
    for (size_t i = 0; i < group.size(); ++i) text += (i > 0 ? "=" : "") + group[i];
  }
  return text;
}

}  // namespace graspbench
