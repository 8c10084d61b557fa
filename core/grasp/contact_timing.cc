#include "core/grasp/contact_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {

std::vector<double> CalcMedianTimes(const std::vector<std::vector<DigitContact>>& trials) {
  std::vector<double> medians;
  for (size_t digit = 0;; ++digit) {
    bool is_digit = false;
    std::vector<double> times;
    for (const std::vector<DigitContact>& contacts : trials) {
      if (digit >= contacts.size()) continue;
      is_digit = true;
      if (!std::isnan(contacts[digit].time)) times.push_back(contacts[digit].time);
    }
    if (!is_digit) return medians;
    medians.push_back(CalcMedian(times));
  }
}

Answer<double> CalcGftFloor(const std::vector<std::vector<DigitContact>>& trials, double t0) {
  const std::vector<double> medians = CalcMedianTimes(trials);
  double latest = -std::numeric_limits<double>::infinity();
  int num_touching = 0, num_complete = 0;
  for (const double median : medians) {
    if (std::isnan(median)) continue;
    latest = std::max(latest, median);
    ++num_touching;
  }
  if (num_touching < 2) return NoAnswer{"fewer than two digits touched"};
  std::vector<double> ratios;
  for (std::vector<DigitContact> contacts : trials) {
    GRASPBENCH_DEMAND(contacts.empty() || contacts.size() == medians.size(),
                      std::to_string(contacts.size()));
    for (size_t i = 0; i < contacts.size(); ++i) contacts[i].time += latest - medians[i];
    const double ratio = CalcContactTiming(contacts, t0).gft_ratio;
    num_complete += std::isnan(ratio) ? 0 : 1;
    ratios.push_back(std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
  }
  if (num_complete < kLeastTrialsOfFloor) {
    return NoAnswer{"all digits touched in " + std::to_string(num_complete) +
                    " of the trials; expected " + std::to_string(kLeastTrialsOfFloor) + " or more"};
  }
  const double floor = CalcMedian(ratios);
  if (std::isinf(floor)) return NoAnswer{"a digit did not touch in half of the trials or more"};
  return floor;
}

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
