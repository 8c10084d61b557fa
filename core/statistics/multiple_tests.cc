#include "core/statistics/multiple_tests.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

/** Returns the indices of the tests made, smallest p first. */
std::vector<size_t> SortTests(const std::vector<double>& p) {
  std::vector<size_t> order;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return p[a] < p[b]; });
  return order;
}

}  // namespace

std::vector<double> AdjustHolm(const std::vector<double>& p) {
  std::vector<double> adjusted = p;
  const std::vector<size_t> order = SortTests(p);
  double largest = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(order.size() - i) * p[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

std::vector<double> AdjustBenjaminiHochberg(const std::vector<double>& p) {
  std::vector<double> adjusted = p;
  const std::vector<size_t> order = SortTests(p);
  const double count = static_cast<double>(order.size());
  double least = 1.0;
  for (size_t i = order.size(); i > 0; --i) {
    least = std::min(least, count * p[order[i - 1]] / static_cast<double>(i));
    adjusted[order[i - 1]] = least;
  }
  return adjusted;
}

}  // namespace graspbench
