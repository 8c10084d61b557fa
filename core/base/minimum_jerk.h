#pragma once
/** @file
The minimum-jerk profile from 0 to 1 (Flash and Hogan 1985) and its rate, for x in [0, 1]. */

namespace graspbench {

inline double CalcMinimumJerk(double x) { return x * x * x * (10.0 + x * (6.0 * x - 15.0)); }
inline double CalcMinimumJerkRate(double x) { return 30.0 * x * x * (1.0 - x) * (1.0 - x); }

}  // namespace graspbench
