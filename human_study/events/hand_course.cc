#include "human_study/events/hand_course.h"

#include <algorithm>
#include <cmath>

#include "core/grasp/pad_geometry.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/** Of all tips; where one is hidden, invalid. */
ScalarCurve MakeEmptyCurve(const std::vector<SmoothPath>& tips) {
  ScalarCurve curve;
  curve.times = tips.front().path.times;
  curve.states = tips.front().path.states;
  for (const SmoothPath& tip : tips) {
    curve.noise = std::fmax(curve.noise, tip.smooth_noise);
    curve.rate_noise = std::fmax(curve.rate_noise, tip.speed_noise);
    curve.reach = std::fmax(curve.reach, tip.reach);
    for (size_t i = 0; i < curve.size(); ++i) {
      curve.states[i] = CombineStates(curve.states[i], tip.path.states[i]);
    }
  }
  curve.values = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(curve.size()), kUnset);
  return curve;
}

Matrix3Xd TakeTips(const std::vector<SmoothPath>& tips, size_t sample) {
  Matrix3Xd places(3, static_cast<Eigen::Index>(tips.size()));
  for (size_t d = 0; d < tips.size(); ++d) {
    places.col(static_cast<Eigen::Index>(d)) = tips[d].path.At(sample);
  }
  return places;
}

/** What has no value is invalid. */
void InvalidateUnset(ScalarCurve& curve) {
  for (size_t i = 0; i < curve.size(); ++i) {
    if (std::isnan(curve.At(i))) curve.states[i] = SampleState::kInvalid;
  }
}

/** Velocities of the tips against the wrist by central differences; NaN columns where a tip is not
clearly faster than its noise. @pre 0 < sample < last. */
Matrix3Xd CalcCourses(const std::vector<SmoothPath>& tips, const SmoothPath& wrist, size_t sample) {
  constexpr double kClearly = 4.0;  // SD
  const double interval = wrist.path.times[sample + 1] - wrist.path.times[sample - 1];
  const auto velocity = [&](const SmoothPath& path) -> Vector3d {
    return (path.path.At(sample + 1) - path.path.At(sample - 1)) / interval;
  };
  Matrix3Xd courses(3, static_cast<Eigen::Index>(tips.size()));
  for (size_t d = 0; d < tips.size(); ++d) {
    const Vector3d course = velocity(tips[d]) - velocity(wrist);
    const double noise = std::hypot(tips[d].speed_noise, wrist.speed_noise);
    const bool is_clear = course.norm() > kClearly * noise;
    courses.col(static_cast<Eigen::Index>(d)) = is_clear ? course : Vector3d::Constant(kUnset);
  }
  return courses;
}

/** The sample nearest to an instant. */
std::ptrdiff_t FindNearest(const std::vector<double>& times, double time) {
  if (!(time >= times.front() && time <= times.back())) return -1;
  return std::lround((time - times.front()) / (times[1] - times[0]));
}

double CalcTurn(const Vector3d& from, const Vector3d& to) {
  return std::atan2(from.cross(to).norm(), from.dot(to));
}

}  // namespace

HandCourse CalcHandCourse(FilteredTrial& trial, double cutoff) {
  const std::vector<SmoothPath>& tips = trial.FilterTips(cutoff);
  HandCourse course;
  course.plane = course.meeting = MakeEmptyCurve(tips);
  const size_t num_samples = course.plane.size();
  course.axis = Matrix3Xd::Constant(3, static_cast<Eigen::Index>(num_samples), kUnset);
  const bool has_wrist = trial.trial().wrist.size() > 0;
  const SmoothPath wrist = has_wrist ? Smooth(trial.trial().wrist, cutoff) : SmoothPath();
  for (size_t i = 0; i < num_samples; ++i) {
    if (!course.plane.IsValid(i)) continue;
    const Matrix3Xd places = TakeTips(tips, i);
    course.plane.At(i) = CalcPlaneResidual(places);
    course.axis.col(static_cast<Eigen::Index>(i)) =
        (places.rightCols(places.cols() - 1).rowwise().mean() - places.col(0)).normalized();
    if (has_wrist && i > 0 && i + 1 < num_samples) {
      course.meeting.At(i) = CalcMeetingResidual(places, CalcCourses(tips, wrist, i));
    }
  }
  InvalidateUnset(course.plane);
  InvalidateUnset(course.meeting);
  return course;
}

double CalcAxisTurn(const HandCourse& course, double from, double to) {
  const std::ptrdiff_t first = FindNearest(course.plane.times, from);
  const std::ptrdiff_t last = FindNearest(course.plane.times, to);
  if (first < 0 || last < 0) return kUnset;
  return CalcTurn(course.axis.col(first), course.axis.col(last));
}

double FindAxisSettling(const HandCourse& course, double begin, double end) {
  const std::ptrdiff_t last = FindNearest(course.plane.times, end);
  const SampleRun samples = FindSamples(course.plane.times, begin, end);
  if (last < 0 || samples.size() == 0 || !course.axis.col(last).allFinite()) return kUnset;
  for (size_t i = samples.last; i-- > samples.first;) {
    const Vector3d axis = course.axis.col(static_cast<Eigen::Index>(i));
    if (CalcTurn(axis, course.axis.col(last)) > kSettledAngle) return course.plane.times[i + 1];
  }
  return begin;
}

double CalcMedianMeeting(const HandCourse& course, double from, double to) {
  std::vector<double> values;
  const SampleRun samples = FindSamples(course.meeting.times, from, to);
  for (size_t i = samples.first; i < samples.last; ++i) values.push_back(course.meeting.At(i));
  return CalcMedianOfFinite(std::move(values));
}

}  // namespace graspbench
