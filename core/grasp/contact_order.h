#pragma once
/** @file
Which digit touched first, second, .. - as far as the data can tell; for robots and people alike.

Two neighbours in time are tied when

    t_b - t_a <= z sqrt(u_a^2 + u_b^2)

with u the standard uncertainties of their times: what 95 % of a normal error can explain. */

#include <string>
#include <vector>

#include "core/grasp/contact_timing.h"

namespace graspbench {

struct ContactOrder {
  /** Groups of tied digits in order of time, also within a group: {{"TH", "FF"}, {"MF"}}. Digits
  that never touched are in none. */
  std::vector<std::vector<std::string>> groups;
  int num_ties = 0;  ///< pairs of neighbours that are tied

  int FindRank(const std::string& digit) const;  ///< 1 for the first group; 0 when it is in none
  std::string Format() const;                    ///< "TH=FF<MF"; empty when none touched
};

/** @param uncertainties  of the contacts' times, each >= 0 [s]; not read where a time is missing.
 */
ContactOrder FindContactOrder(const std::vector<DigitContact>& contacts,
                              const std::vector<double>& uncertainties);

}  // namespace graspbench
