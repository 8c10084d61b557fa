#pragma once
/** @file
Which digit touched first, second, .. - as far as the data can tell. */

#include <string>
#include <vector>

#include "human_study/events/contact_detector.h"

namespace graspbench {

struct ContactOrder {
  /** Groups in order of time, digits within a group in order of time: {{"TH", "FF"}, {"MF"}}. Two
  neighbours are tied when their times differ by less than 1.96 times the root of the sum of their
  squared uncertainties. */
  std::vector<std::vector<std::string>> groups;
  std::vector<std::string> missing;  ///< digits without a contact
  int num_ties = 0;                  ///< pairs of neighbours that are tied

  std::string Format() const;  ///< "TH=FF<MF"; empty when none touched
};

ContactOrder FindContactOrder(const std::vector<DigitContactEvents>& contacts);

}  // namespace graspbench
