#pragma once
/** @file
All quantities inside the program are in SI units (m, kg, s, rad, N) and have no suffix. A quantity
in another unit has a suffix in its name (`_mm`, `_deg`, `_g`, `_ms`) and is converted here, at the
program's boundary, and nowhere else. */

#include <limits>

namespace graspbench {

/** Marks a quantity without a value. It is written as null or an empty cell, never as a plausible
number. */
inline constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kStandardGravity = 9.80665;  ///< [m/s^2]

constexpr double RadFromDeg(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double DegFromRad(double angle) { return angle * (180.0 / kPi); }
constexpr double MFromMm(double length_mm) { return length_mm * 1e-3; }
constexpr double MmFromM(double length) { return length * 1e3; }
constexpr double GFromKg(double mass) { return mass * 1e3; }
constexpr double MsFromS(double time) { return time * 1e3; }
constexpr double MjFromJ(double energy) { return energy * 1e3; }

}  // namespace graspbench
