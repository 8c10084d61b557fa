#pragma once
/** @file
When each digit touches, in shares of the closing time, for people and robots alike: the one measure
that a robot which closes at a set speed shares with a person. Of a trial with first contacts t_d of
the digits that are compared and the start t0 of closure (core/grasp/contact_timing.h),

    share_d = (t_d - min t) / (max t - t0),

min and max over the digits that touched; a digit that never touched has an infinite share, later
than every other. Median and quartiles are those of the trials, infinite shares in their place
(type 7; between a finite and an infinite value: infinite).

A trial is left out, and counted, where a digit's contact cannot be told, t0 is not known, or a
contact came before t0. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/contact_timing.h"
#include "core/statistics/answer.h"

namespace graspbench {

/** What one trial says of its contacts. */
struct TrialTouches {
  std::string object;
  double start = kUnset;               ///< of closure, on the clock of the contacts [s]
  std::vector<DigitContact> contacts;  ///< NaN: never touched; a digit without an entry: not known
};

struct DigitShare {
  std::string digit;
  double low = kUnset, median = kUnset, high = kUnset;  ///< quartiles; infinite: never touched
  int num_never = 0;
};

struct TouchLags {
  int num_trials = 0;              ///< that take part
  int num_left_out = 0;            ///< as above
  double closing_time = kUnset;    ///< median of max t - t0 where a digit touched [s]
  double gft = kUnset;             ///< median; infinite: a digit never touched in half of them [s]
  std::vector<DigitShare> shares;  ///< in the order of the digits asked for

  const DigitShare& Of(const std::string& digit) const;
};

/** @param digits  that are compared.
@returns no answer, with the reason, without a trial that takes part or a touch in them, of digits
that no trial knows, and for closing times that cannot be seconds. */
Answer<TouchLags> SummariseTouches(const std::vector<TrialTouches>& trials,
                                   const std::vector<std::string>& digits);

/** Infinite is null. */
Json ToJson(const TouchLags& lags);
/** @throws Json::exception. */
TouchLags TouchLagsFromJson(const Json& json);

}  // namespace graspbench
