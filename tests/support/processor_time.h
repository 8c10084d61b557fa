#pragma once
/** @file
How processor time grows with the size of an input. */

#include <algorithm>
#include <ctime>
#include <limits>

namespace graspbench {

/** Processor time for 40,000 things over that for 10,000, each the shortest of three runs: about 4
where time is linear, 16 where it is quadratic. Other programs of the machine lengthen runs, so that
a test expects less than 8. @param run  takes the number of things. */
template <class Run>
double FindTimeRatio(const Run& run) {
  const auto find_time = [&](int count) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const std::clock_t start = std::clock();
      run(count);
      shortest = std::min(shortest, static_cast<double>(std::clock() - start));
    }
    return shortest;
  };
  const double of_few = find_time(10'000);
  return find_time(40'000) / of_few;
}

}  // namespace graspbench
