#pragma once
/** @file
The one way in which tables and sentences write a range, and a part of a count. */

#include <cstdint>
#include <string>

namespace graspbench {

/** "0.12 to 0.34". */
std::string FormatRange(double low, double high, int decimals);

/** "0.23 (0.12 to 0.34)"; the value alone where the range is NaN. */
std::string FormatWithRange(double estimate, double low, double high, int decimals);

/** "10", or "6 of 10" where not all are counted. */
std::string FormatCountOf(int64_t count, int64_t num_all);

}  // namespace graspbench
