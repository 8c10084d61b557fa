#pragma once
/** @file
Numbers that somebody else wrote, as sizes and indices. A cast of a number that the type does not
hold has no defined result, so every reader of foreign files converts here (tests/lint looks). */

#include <cmath>
#include <limits>

namespace graspbench {

/** Without its fraction; the type's limit for what lies beyond it, 0 for what is no number. Whether
a number makes sense is for the reader to check. */
template <class Whole>
Whole ToWhole(double value) {
  using Limits = std::numeric_limits<Whole>;
  if (std::isnan(value)) return 0;
  if (value >= std::ldexp(1.0, Limits::digits)) return Limits::max();
  if (value <= static_cast<double>(Limits::min())) return Limits::min();
  return static_cast<Whole>(value);
}

}  // namespace graspbench
