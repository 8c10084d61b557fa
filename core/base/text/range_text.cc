#include "core/base/text/range_text.h"

#include <cmath>

#include "core/base/text/text.h"

namespace graspbench {

std::string FormatRange(double low, double high, int decimals) {
  return FormatFixed(low, decimals) + " to " + FormatFixed(high, decimals);
}

std::string FormatWithRange(double estimate, double low, double high, int decimals) {
  const std::string text = FormatFixed(estimate, decimals);
  return std::isfinite(low) ? text + " (" + FormatRange(low, high, decimals) + ")" : text;
}

std::string FormatCountOf(int64_t count, int64_t num_all) {
  const std::string text = std::to_string(count);
  return count == num_all ? text : text + " of " + std::to_string(num_all);
}

}  // namespace graspbench
