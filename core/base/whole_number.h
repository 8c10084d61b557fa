#pragma once
/** @file
Safe conversion of foreign numbers, such as sizes and indices, to integers. A cast of a number that
the type cannot represent is undefined, so every reader of foreign files converts here (checked in
tests/lint). */

#include <cmath>
#include <limits>

namespace graspbench {

/** Truncates towards zero; saturates at the type's limits and returns 0 for NaN. The reader must
check whether the number is plausible. */
template <class Whole>
Whole ToWhole(double value) {
  using Limits = std::numeric_limits<Whole>;
  if (std::isnan(value)) return 0;
  if (value >= std::ldexp(1.0, Limits::digits)) return Limits::max();
  if (value <= static_cast<double>(Limits::min())) return Limits::min();
  return static_cast<Whole>(value);
}

}  // namespace graspbench
