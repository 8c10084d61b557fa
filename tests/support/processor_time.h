#pragma once
/** @file
How processor time grows with the size of an input. */

#include <algorithm>
#include <ctime>
#include <limits>

namespace graspbench {

/** Processor time for 40,000 things over that for 10,000: about 4 where time is linear, 16 where it
is quadratic; a test expects less than 8. Each is the shortest of runs that take turns, because other
programs of the machine lengthen runs: three of each, and up to nine while the ratio is 8 or more.
@param run  takes the number of things. */
template <class Run>
double FindTimeRatio(const Run& run) {
  const auto measure = [&](int count) {
    const std::clock_t start = std::clock();
    run(count);
    return static_cast<double>(std::clock() - start);
  };
  double few = std::numeric_limits<double>::infinity(), many = few;
  for (int i = 0; i < 3 || (i < 9 && many >= 8.0 * few); ++i) {
    few = std::min(few, measure(10'000));
    many = std::min(many, measure(40'000));
  }
  return many / few;
}

}  // namespace graspbench
