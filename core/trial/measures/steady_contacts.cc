#include "core/trial/measures/steady_contacts.h"

#include <algorithm>
#include <cmath>

namespace graspbench {

void SteadyContacts::Observe(const std::vector<HandContact>& contacts, double table_force,
                             double slip_speed, double duration) {
  bool is_steady = !contacts.empty() && table_force == 0.0 && slip_speed <= kSteadySlip &&
                   contacts.size() == links_.size();
  for (size_t i = 0; i < contacts.size() && is_steady; ++i) {
    is_steady = contacts[i].link == links_[i] && !IsSliding(contacts[i]);
  }
  steady_time_ = is_steady ? steady_time_ + duration : 0.0;
  links_.clear();
  for (const HandContact& contact : contacts) links_.push_back(contact.link);
}

int CalcSteadySteps(const SimConfig& config) {
  const int longest = static_cast<int>(std::floor(kLongestStep / config.step + 1e-9));
  return std::max(1, std::min(config.steady_step_factor, longest));
}

}  // namespace graspbench
