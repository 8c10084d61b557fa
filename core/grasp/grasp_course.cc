#include "core/grasp/grasp_course.h"

#include <algorithm>
#include <utility>

namespace graspbench {
namespace {

/** Value and rate of the cubic. */
template <class Value>
std::pair<Value, Value> InterpolateCourse(const std::vector<Value>& values, double period,
                                          double time, const Value& zero) {
  const double last = static_cast<double>(values.size()) - 1.0, x = time / period;
  if (x < 0.0 || values.size() == 1) return {values.front(), zero};
  if (x >= last) return {values.back(), zero};
  const auto i = static_cast<size_t>(x);
  const double u = x - static_cast<double>(i);
  const auto find_slope = [&](size_t k) -> Value {
    if (k + 1 == values.size()) return zero;
    if (k == 0) return values[1] - values[0];
    return 0.5 * (values[k + 1] - values[k - 1]);
  };
  const Value a = values[i], b = values[i + 1], da = find_slope(i), db = find_slope(i + 1);
  const Value c2 = 3.0 * (b - a) - 2.0 * da - db, c3 = 2.0 * (a - b) + da + db;
  return {a + u * (da + u * (c2 + u * c3)), (da + u * (2.0 * c2 + 3.0 * u * c3)) / period};
}

}  // namespace

Eigen::Vector3d CalcHandAway(const GraspCourse& course, double time) {
  return InterpolateCourse<Eigen::Vector3d>(course.p_HAway, course.period, time,
                                            Eigen::Vector3d::Zero())
      .first;
}

Eigen::Vector3d CalcHandSpeed(const GraspCourse& course, double time) {
  return InterpolateCourse<Eigen::Vector3d>(course.p_HAway, course.period, time,
                                            Eigen::Vector3d::Zero())
      .second;
}

double CalcCourseClosing(const std::vector<double>& values, double period, double time) {
  if (values.empty()) return 0.0;
  return std::clamp(InterpolateCourse<double>(values, period, time, 0.0).first, 0.0, 1.0);
}

}  // namespace graspbench
