#include "datasets/analysis/schedules/touch_lags.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

/** No hand closes faster or slower: such times are in another unit [s]. */
constexpr double kLeastClosing = 0.01, kMostClosing = 30.0;

/** Type 7 with infinite values in their place. */
double CalcQuantile(std::vector<double> values, double probability) {
  std::sort(values.begin(), values.end());
  const double place = probability * static_cast<double>(values.size() - 1);
  const double low = values[static_cast<size_t>(std::floor(place))];
  const double high = values[static_cast<size_t>(std::ceil(place))];
  return low == high ? low : low + (place - std::floor(place)) * (high - low);
}

/** The trial's contacts of the digits, in their order; empty: one is not known. */
std::vector<double> FindTimes(const TrialTouches& trial, const std::vector<std::string>& digits) {
  std::vector<double> times;
  for (const std::string& digit : digits) {
    const auto contact = std::find_if(trial.contacts.begin(), trial.contacts.end(),
                                      [&](const DigitContact& c) { return c.digit == digit; });
    if (contact == trial.contacts.end()) return {};
    times.push_back(std::isnan(contact->time) ? HUGE_VAL : contact->time);
  }
  return times;
}

/** NaN: no digit touched. */
double FindLastTouch(const std::vector<double>& times) {
  double last = kUnset;
  for (const double time : times) {
    if (!std::isinf(time) && !(time <= last)) last = time;
  }
  return last;
}

/** The digits of which no trial says anything. */
std::string ListUnknown(const std::vector<TrialTouches>& trials,
                        const std::vector<std::string>& digits) {
  std::string unknown;
  for (const std::string& digit : digits) {
    const bool is_known = std::any_of(trials.begin(), trials.end(), [&](const auto& trial) {
      return !FindTimes(trial, {digit}).empty();
    });
    if (!is_known) unknown += (unknown.empty() ? "" : ", ") + digit;
  }
  return unknown;
}

Json JsonShare(double share) { return std::isinf(share) ? Json(nullptr) : Json(share); }
double ShareFromJson(const Json& json) { return json.is_null() ? HUGE_VAL : json.get<double>(); }

}  // namespace

const DigitShare& TouchLags::Of(const std::string& digit) const {
  const auto share = std::find_if(shares.begin(), shares.end(),
                                  [&](const DigitShare& known) { return known.digit == digit; });
  GRASPBENCH_DEMAND(share != shares.end(), digit);
  return *share;
}

Answer<TouchLags> SummariseTouches(const std::vector<TrialTouches>& trials,
                                   const std::vector<std::string>& digits) {
  if (trials.empty()) return NoAnswer{"there is no trial"};
  const std::string unknown = ListUnknown(trials, digits);
  if (!unknown.empty()) return NoAnswer{"no contact is known of " + unknown};
  TouchLags lags;
  std::vector<double> closing, gft;
  std::vector<std::vector<double>> shares(digits.size());
  for (const TrialTouches& trial : trials) {
    const std::vector<double> times = FindTimes(trial, digits);
    const double first = times.empty() ? 0.0 : *std::min_element(times.begin(), times.end());
    const double length = FindLastTouch(times) - trial.start;
    if (times.empty() || std::isnan(trial.start) || first < trial.start || length <= 0.0) {
      ++lags.num_left_out;
      continue;
    }
    ++lags.num_trials;
    const bool is_touched = !std::isinf(first);
    if (is_touched) closing.push_back(length);
    const double last = *std::max_element(times.begin(), times.end());
    gft.push_back(is_touched ? last - first : HUGE_VAL);
    for (size_t i = 0; i < digits.size(); ++i) {
      shares[i].push_back(is_touched ? (times[i] - first) / length : HUGE_VAL);
    }
  }
  if (lags.num_trials == 0) {
    return NoAnswer{"none of " + FormatCount(lags.num_left_out, "trial") +
                    " has a known start of closure and known contacts after it"};
  }
  if (closing.empty()) return NoAnswer{"no digit touched in any trial"};
  lags.closing_time = CalcMedian(closing);
  if (lags.closing_time < kLeastClosing || lags.closing_time > kMostClosing) {
    return NoAnswer{"closing takes " + FormatJson(lags.closing_time) +
                    " s in the median; expected 0.01 to 30 s: are its times in seconds?"};
  }
  lags.gft = CalcMedian(gft);
  for (size_t i = 0; i < digits.size(); ++i) {
    const auto is_never = [](double share) { return std::isinf(share); };
    lags.shares.push_back(
        {digits[i], CalcQuantile(shares[i], 0.25), CalcQuantile(shares[i], 0.5),
         CalcQuantile(shares[i], 0.75),
         static_cast<int>(std::count_if(shares[i].begin(), shares[i].end(), is_never))});
  }
  return lags;
}

Json ToJson(const TouchLags& lags) {
  Json shares = Json::array();
  for (const DigitShare& share : lags.shares) {
    shares.push_back({{"digit", share.digit},
                      {"low", JsonShare(share.low)},
                      {"median", JsonShare(share.median)},
                      {"high", JsonShare(share.high)},
                      {"never", share.num_never}});
  }
  return {{"trials", lags.num_trials},
          {"left_out", lags.num_left_out},
          {"closing_time_s", lags.closing_time},
          {"gft_s", JsonShare(lags.gft)},
          {"shares", shares}};
}

TouchLags TouchLagsFromJson(const Json& json) {
  TouchLags lags;
  lags.num_trials = json.at("trials").get<int>();
  lags.num_left_out = json.at("left_out").get<int>();
  lags.closing_time = json.at("closing_time_s").get<double>();
  lags.gft = ShareFromJson(json.at("gft_s"));
  for (const Json& share : json.at("shares")) {
    lags.shares.push_back({share.at("digit").get<std::string>(), ShareFromJson(share.at("low")),
                           ShareFromJson(share.at("median")), ShareFromJson(share.at("high")),
                           share.at("never").get<int>()});
  }
  return lags;
}

}  // namespace graspbench
