#include "core/grasp/contact_order.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/statistics/distributions.h"

namespace graspbench {

ContactOrder FindContactOrder(const std::vector<DigitContact>& contacts,
                              const std::vector<double>& uncertainties) {
  GRASPBENCH_DEMAND(contacts.size() == uncertainties.size(),
                    std::to_string(contacts.size()) + " contacts, " +
                        std::to_string(uncertainties.size()) + " uncertainties");
  std::vector<size_t> touching;
  for (size_t i = 0; i < contacts.size(); ++i) {
    if (!std::isnan(contacts[i].time)) touching.push_back(i);
  }
  std::stable_sort(touching.begin(), touching.end(),
                   [&](size_t a, size_t b) { return contacts[a].time < contacts[b].time; });
  ContactOrder order;
  for (size_t i = 0; i < touching.size(); ++i) {
    const size_t digit = touching[i];
    bool is_tied = false;
    if (i > 0) {
      const size_t before = touching[i - 1];
      is_tied = contacts[digit].time - contacts[before].time <=
                kNormal95 * std::hypot(uncertainties[before], uncertainties[digit]);
    }
    order.num_ties += is_tied;
    if (!is_tied) order.groups.emplace_back();
    order.groups.back().push_back(contacts[digit].digit);
  }
  return order;
}

int ContactOrder::FindRank(const std::string& digit) const {
  for (size_t i = 0; i < groups.size(); ++i) {
    const std::vector<std::string>& group = groups[i];
    if (std::find(group.begin(), group.end(), digit) != group.end()) return static_cast<int>(i) + 1;
  }
  return 0;
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
