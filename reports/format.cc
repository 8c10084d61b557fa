#include "reports/format.h"

#include <charconv>
#include <cmath>

#include "core/statistics/proportion.h"

namespace graspbench {
namespace {

constexpr char kNoBreakSpace[] = "\u00A0";

// std::to_chars knows no locale, unlike printf.
std::string Format(double value, std::chars_format format, int precision) {
  if (!std::isfinite(value)) return "n/a";
  char buffer[512];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, precision).ptr;
  std::string text(buffer, end);
  const bool is_minus_zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return is_minus_zero ? text.substr(1) : text;
}

}  // namespace

std::string FormatFixed(double value, int decimals) {
  return Format(value, std::chars_format::fixed, decimals);
}

std::string FormatSignificant(double value, int digits) {
  return Format(value, std::chars_format::general, digits);
}

std::string FormatPercent(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) + kNoBreakSpace + "%" : "n/a";
}

std::string FormatCount(int count, const std::string& singular) {
  return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

std::string FormatRate(int successes, int n) {
  const std::string counts = std::to_string(successes) + " of " + FormatCount(n, "trial");
  if (n == 0) return counts;
  return counts + " (" + FormatPercent(static_cast<double>(successes) / n) + ", 95" +
         kNoBreakSpace + "% interval " + FormatRateInterval(successes, n) + kNoBreakSpace + "%)";
}

std::string FormatRateInterval(int successes, int n) {
  if (n == 0) return "n/a";
  const Interval interval = CalcWilsonInterval(successes, n);
  return FormatFixed(100.0 * interval.low, 1) + " to " + FormatFixed(100.0 * interval.high, 1);
}

}  // namespace graspbench
