#include "human_study/recording/cleaning/exchanged_labels.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr size_t kFramesOfCourse = 3;  // that tell how a marker moves
constexpr double kLongestGap = 0.12;   // [s]
constexpr double kLeastMiss = 5e-3;    // of its own course [m]
constexpr double kUsualMisses = 4.0;   // of its median
constexpr double kOnCourse = 0.35;     // of its own miss: it is on the other's course
constexpr double kAlsoOff = 0.5;       // of that: the other is not on its own
constexpr double kSameWay = 0.5;       // cosine

/** One marker's course. */
struct Course {
  const Trajectory* track = nullptr;
  Eigen::Matrix3Xd before, after;    ///< mean velocity up to, and from, each sample; NaN: not seen
  std::vector<std::ptrdiff_t> last;  ///< valid sample before each; -1: none within a gap
  std::vector<double> miss;          ///< of its own course [m]; NaN: not known
  double limit = 0.0;                ///< a miss below is none [m]
};

/** From where x goes from i to where y is in j; NaN when neither shows how it moves. */
Vector3d CalcOffset(const Course& x, size_t i, const Course& y, size_t j) {
  const double interval = x.track->times[j] - x.track->times[i];
  const Vector3d way = y.track->At(j) - x.track->At(i);
  const Vector3d before = x.before.col(static_cast<Eigen::Index>(i));
  const Vector3d after = y.after.col(static_cast<Eigen::Index>(j));
  Vector3d least = Vector3d::Constant(std::nan(""));
  for (const Vector3d& velocity : {before, after, Vector3d(0.5 * (before + after))}) {
    const Vector3d offset = way - interval * velocity;
    if (std::isnan(least.x()) || offset.norm() < least.norm()) least = offset;
  }
  return least;
}
double CalcMiss(const Course& x, size_t i, const Course& y, size_t j) {
  return CalcOffset(x, i, y, j).norm();
}

Course MakeCourse(const Trajectory& track) {
  const size_t num_frames = track.size();
  Course course;
  course.track = &track;
  course.before = course.after =
      Eigen::Matrix3Xd::Constant(3, static_cast<Eigen::Index>(num_frames), std::nan(""));
  for (size_t i = 0; i + kFramesOfCourse < num_frames; ++i) {
    const size_t j = i + kFramesOfCourse;
    if (!track.IsValid(i) || !track.IsValid(j)) continue;
    const Vector3d velocity = (track.At(j) - track.At(i)) / (track.times[j] - track.times[i]);
    course.after.col(static_cast<Eigen::Index>(i)) = velocity;
    course.before.col(static_cast<Eigen::Index>(j)) = velocity;
  }
  std::ptrdiff_t last = -1;
  std::vector<double> known;
  for (size_t j = 0; j < num_frames; ++j) {
    const bool is_near =
        last >= 0 && track.times[j] - track.times[static_cast<size_t>(last)] <= kLongestGap;
    course.last.push_back(is_near ? last : -1);
    course.miss.push_back(std::nan(""));
    if (!track.IsValid(j)) continue;
    if (is_near) course.miss[j] = CalcMiss(course, static_cast<size_t>(last), course, j);
    if (!std::isnan(course.miss[j])) known.push_back(course.miss[j]);
    last = static_cast<std::ptrdiff_t>(j);
  }
  const double usual = known.empty() ? 0.0 : CalcMedian(std::move(known));
  course.limit = std::max(kLeastMiss, kUsualMisses * usual);
  return course;
}

/** Label x goes on in frame j where the marker of y was. Where frames are lost it may, too, but then
y goes the same way. */
bool IsOnCourseOf(const Course& y, const Course& x, size_t j) {
  if (y.last[j] < 0) return false;
  const auto last_of_y = static_cast<size_t>(y.last[j]);
  const double own = x.miss[j];
  if (!(CalcMiss(y, last_of_y, x, j) < kOnCourse * own)) return false;
  if (!y.track->IsValid(j)) return true;
  if (!(y.miss[j] > kAlsoOff * own)) return false;
  const Vector3d of_x = CalcOffset(x, static_cast<size_t>(x.last[j]), x, j);
  const Vector3d of_y = CalcOffset(y, last_of_y, y, j);
  return of_x.dot(of_y) < kSameWay * of_x.norm() * of_y.norm();
}

}  // namespace

std::vector<LabelExchange> FindLabelExchanges(const std::vector<Trajectory>& tracks) {
  std::vector<Course> courses;
  for (const Trajectory& track : tracks) courses.push_back(MakeCourse(track));
  std::vector<LabelExchange> exchanges;
  for (size_t j = 0; !tracks.empty() && j < tracks.front().size(); ++j) {
    for (size_t x = 0; x < courses.size(); ++x) {
      if (!(courses[x].miss[j] > courses[x].limit)) continue;
      for (size_t y = 0; y < courses.size(); ++y) {
        if (y == x || !IsOnCourseOf(courses[y], courses[x], j)) continue;
        exchanges.push_back({j, x, y, courses[x].miss[j]});
      }
    }
  }
  return exchanges;
}

}  // namespace graspbench
