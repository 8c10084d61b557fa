#include "human_study/events/hand_opening.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

namespace {

using Tips = Eigen::Matrix3Xd;

Eigen::Index Next(const Tips& tips, Eigen::Index i) { return (i + 1) % tips.cols(); }

double CalcTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm() / 2;
}

double CalcAperture(const Tips& tips) { return (tips.col(0) - tips.col(1)).norm(); }

double CalcVirtualFinger(const Tips& tips) {
  return (tips.col(0) - tips.rightCols(tips.cols() - 1).rowwise().mean()).norm();
}

double CalcThumbFinger(const Tips& tips) {
  return (tips.rightCols(tips.cols() - 1).colwise() - tips.col(0)).colwise().norm().mean();
}

double CalcRmsRadius(const Tips& tips) {
  return std::sqrt((tips.colwise() - tips.rowwise().mean()).colwise().squaredNorm().mean());
}

double CalcCentroidSum(const Tips& tips) {
  return (tips.colwise() - tips.rowwise().mean()).colwise().norm().sum();
}

double CalcFan(const Tips& tips) {
  const Eigen::Vector3d centre = tips.rowwise().mean();
  double area = 0.0;
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    area += CalcTriangle(centre, tips.col(i), tips.col(Next(tips, i)));
  }
  return std::sqrt(area);
}

double CalcPerimeter(const Tips& tips) {
  double length = 0.0;
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    length += (tips.col(i) - tips.col(Next(tips, i))).norm();
  }
  return length;
}

double CalcOuterTriangle(const Tips& tips) {
  return std::sqrt(CalcTriangle(tips.col(0), tips.col(1), tips.col(tips.cols() - 1)));
}

double CalcTetrahedron(const Tips& tips, const std::array<Eigen::Index, 4>& of) {
  const Eigen::Vector3d origin = tips.col(of[0]);
  return std::abs(
             (tips.col(of[1]) - origin)
                 .dot(
                     (tips.col(of[2]) - origin).cross(Eigen::Vector3d(tips.col(of[3]) - origin)))) /
         6;
}

double CalcHull(const Tips& tips) {
  if (tips.cols() == 4) return std::cbrt(CalcTetrahedron(tips, {0, 1, 2, 3}));
  GRASPBENCH_DEMAND(tips.cols() == 5, std::to_string(tips.cols()));
  double sum = 0.0;
  for (Eigen::Index out = 0; out < 5; ++out) {
    sum += CalcTetrahedron(tips, {(out + 1) % 5, (out + 2) % 5, (out + 3) % 5, (out + 4) % 5});
  }
  return std::cbrt(sum / 2);
}

}  // namespace

const std::vector<HandOpening>& HandOpeningList() {
  static const std::vector<HandOpening> openings = {
      {"aperture", "distance of the thumb's tip from the index finger's (grip aperture)",
       CalcAperture, 2},
      {"virtual_finger",
       "distance of the thumb's tip from the mean of the other tips (virtual finger)",
       CalcVirtualFinger, 2},
      {"thumb_finger", "mean distance of the thumb's tip from the other tips", CalcThumbFinger, 2},
      {"rms_radius", "root mean square distance of the tips from their centroid", CalcRmsRadius, 2},
      {"centroid_sum", "sum of the distances of the tips from their centroid", CalcCentroidSum, 2},
      {"fan", "square root of the area of the fan of tips about their centroid", CalcFan, 3},
      {"perimeter", "length of the polygon of tips", CalcPerimeter, 2},
      {"outer_triangle",
       "square root of the area of the triangle of the thumb's, the index and the last digit's tip",
       CalcOuterTriangle, 3},
      {"hull", "cube root of the volume of the convex hull of the tips", CalcHull, 4},
  };
  return openings;
}

const HandOpening& FindHandOpening(const std::string& id) {
  std::vector<std::string> known;
  for (const HandOpening& opening : HandOpeningList()) {
    if (opening.id == id) return opening;
    known.push_back(opening.id);
  }
  throw Error(ErrorKind::kNotFound, "no hand opening \"" + id + "\"" + SuggestNames(id, known));
}

ScalarCurve CalcOpeningCurve(FilteredTrial& trial, const HandOpening& opening, double cutoff,
                             const std::string& left_out) {
  const std::vector<DigitTrack>& digits = trial.trial().digits;
  const std::vector<SmoothPath>& all_tips = trial.FilterTips(cutoff);
  std::vector<const SmoothPath*> tips;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (digits[i].digit != left_out) tips.push_back(&all_tips[i]);
  }
  ScalarCurve curve;
  curve.times = trial.trial().times;
  curve.states.assign(curve.size(), SampleState::kMeasured);
  curve.values = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(curve.size()), std::nan(""));
  if (tips.size() < static_cast<size_t>(opening.min_digits)) {
    curve.states.assign(curve.size(), SampleState::kInvalid);
    return curve;
  }
  double square_noise = 0.0, square_rate_noise = 0.0;
  for (const SmoothPath* tip : tips) {
    square_noise += tip->smooth_noise * tip->smooth_noise;
    square_rate_noise += tip->speed_noise * tip->speed_noise;
  }
  // A distance of two tips, the pattern of all these measures, has the noise of two coordinates.
  const double share = 2.0 / static_cast<double>(tips.size());
  curve.noise = std::sqrt(share * square_noise);
  curve.rate_noise = std::sqrt(share * square_rate_noise);
  curve.reach = tips[0]->reach;

  Tips at(3, static_cast<Eigen::Index>(tips.size()));
  for (size_t i = 0; i < curve.size(); ++i) {
    for (size_t d = 0; d < tips.size(); ++d) {
      curve.states[i] = CombineStates(curve.states[i], tips[d]->path.states[i]);
      at.col(static_cast<Eigen::Index>(d)) = tips[d]->path.At(i);
    }
    if (curve.IsValid(i)) curve.At(i) = opening.calc(at);
  }
  return curve;
}

namespace {

/** Top of the parabola through a sample and its neighbours. */
EventTime RefinePeak(const ScalarCurve& curve, size_t peak, double& value) {
  EventTime event;
  event.time = curve.times[peak];
  event.uncertainty = curve.Interval() / std::sqrt(12.0);
  event.is_filled = HasFilledNear(curve, event.time);
  value = curve.At(peak);
  if (peak == 0 || peak + 1 >= curve.size() || !curve.IsValid(peak - 1) ||
      !curve.IsValid(peak + 1)) {
    event.is_in_gap = true;
    return event;
  }
  const double before = curve.At(peak - 1);
  const double after = curve.At(peak + 1);
  const double bend = before - 2 * value + after;  // curvature * interval^2
  if (!(bend < 0.0)) return event;
  const double shift = std::clamp((before - after) / (2 * bend), -0.5, 0.5);
  event.time += shift * curve.Interval();
  value -= 0.25 * (before - after) * shift;
  const double curvature = bend / (curve.Interval() * curve.Interval());
  event.uncertainty = std::hypot(event.uncertainty, curve.rate_noise / curvature);
  return event;
}

/** Going back from the end, the highest sample before the curve has fallen by `min_prominence`. */
int FindLastPeak(const ScalarCurve& curve, const SampleRun& samples, double min_prominence) {
  int peak = -1;
  for (size_t i = samples.last; i-- > samples.first;) {
    if (!curve.IsValid(i)) continue;
    const double value = curve.At(i);
    if (peak < 0 || value > curve.values[peak]) {
      peak = static_cast<int>(i);
    } else if (value < curve.values[peak] - min_prominence) {
      break;
    }
  }
  return peak;
}

}  // namespace

PeakOpening FindPeakOpening(const ScalarCurve& opening, double begin, double first_contact,
                            double end, double min_prominence) {
  PeakOpening result;
  const int largest = FindPeak(opening, FindSamples(opening.times, begin, end));
  const double last_end = std::isnan(first_contact) ? end : first_contact;
  const int last =
      FindLastPeak(opening, FindSamples(opening.times, begin, last_end), min_prominence);
  if (largest < 0 || last < 0) {
    result.largest = result.last = MissingEvent("the opening is not seen during the movement");
    return result;
  }
  result.largest = RefinePeak(opening, static_cast<size_t>(largest), result.largest_value);
  result.last = RefinePeak(opening, static_cast<size_t>(last), result.last_value);
  result.is_ambiguous = largest != last;
  return result;
}

}  // namespace graspbench
