#pragma once
/** @file
In which order the digits touched, over the trials that count. Ties are what the recording cannot
decide (core/grasp/contact_order.h). */

#include <string>
#include <utility>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

struct FirstDigits {
  std::string participant;
  std::vector<int> counts;  ///< of each digit that touched first alone; last: tied trials
};

/** Of the trials in which both digits touched. */
struct Precedence {
  int num_before = 0, num_both = 0;
  double share() const { return CalcShare(num_before, num_both); }
};

struct OrderCount {
  std::string order;  ///< "TH=FF<MF", tied digits in the order of the hand
  int count = 0;
  double share = 0.0;
};

struct OrderSummary {
  std::vector<FirstDigits> first;
  std::vector<std::vector<Precedence>> precedence;  ///< [a][b]: digit a before digit b
  std::vector<OrderCount> orders;                   ///< most frequent first
  int num_ties = 0, num_neighbours = 0;             ///< pairs of digits next to each other in time
};

/** Digits are in the order of `result.digits`. */
OrderSummary SummariseOrders(const StudyResult& result);

}  // namespace graspbench
