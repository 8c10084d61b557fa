#include "core/grasp/contact_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace graspbench {

ContactTiming CalcContactTiming(const std::vector<DigitContact>& contacts, double t0) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ContactTiming timing{kMissing, kMissing, kMissing, kMissing, kMissing, false};

  double first = kInfinity, last = -kInfinity, first_finger = kInfinity, opposing = kMissing;
  bool all_touched = !contacts.empty();
  int num_opposing = 0;
  for (const DigitContact& contact : contacts) {
    num_opposing += contact.is_opposing;
    if (contact.is_opposing) opposing = contact.time;
    if (std::isnan(contact.time)) {
      all_touched = false;
      continue;
    }
    first = std::min(first, contact.time);
    last = std::max(last, contact.time);
    if (!contact.is_opposing) first_finger = std::min(first_finger, contact.time);
  }
  GRASPBENCH_DEMAND(num_opposing <= 1, "opposing digits: " + std::to_string(num_opposing));

  timing.contact_before_start = first < t0;
  if (all_touched) {
    timing.gct = last - t0;
    timing.gft = last - first;
  }
  if (std::isfinite(opposing) && std::isfinite(first_finger)) {
    timing.got = std::abs(opposing - first_finger);
  }
  if (timing.gct > 0.0) {
    timing.gft_ratio = timing.gft / timing.gct;
    timing.got_ratio = timing.got / timing.gct;
  }

  const auto values = [&] {
    return "GCT " + std::to_string(timing.gct) + ", GFT " + std::to_string(timing.gft) + ", GOT " +
           std::to_string(timing.got);
  };
  if (all_touched && first >= t0) {
    GRASPBENCH_DEMAND(timing.gct >= timing.gft, values());
  }
  if (all_touched && std::isfinite(timing.got)) {
    GRASPBENCH_DEMAND(timing.gft >= timing.got, values());
    if (contacts.size() == 2) GRASPBENCH_DEMAND(timing.gft == timing.got, values());
  }
  return timing;
}

}  // namespace graspbench
