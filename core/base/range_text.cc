#include "core/base/range_text.h"

#include "core/base/text.h"

namespace graspbench {

std::string FormatRange(double low, double high, int decimals) {
  return FormatFixed(low, decimals) + " to " + FormatFixed(high, decimals);
}

std::string FormatWithRange(double estimate, double low, double high, int decimals) {
  return FormatFixed(estimate, decimals) + " (" + FormatRange(low, high, decimals) + ")";
}

}  // namespace graspbench
