#include "human_study/events/reach_trial.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "human_study/events/scalar_curve.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

SurfaceDistance MakeSphereDistance(double radius) {
  GRASPBENCH_DEMAND(radius > 0.0, std::to_string(radius));
  return [radius](const Eigen::Vector3d& p_O) { return p_O.norm() - radius; };
}

SurfaceDistance MakeCylinderDistance(double radius, double height) {
  GRASPBENCH_DEMAND(radius > 0.0 && height > 0.0, std::to_string(radius));
  return [radius, height](const Eigen::Vector3d& p_O) {
    const Eigen::Vector2d beyond(p_O.head<2>().norm() - radius, std::abs(p_O.z()) - height / 2);
    return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0.0).norm();
  };
}

SurfaceDistance MakeBoxDistance(const Eigen::Vector3d& size) {
  GRASPBENCH_DEMAND(size.minCoeff() > 0.0, std::to_string(size.minCoeff()));
  return [size](const Eigen::Vector3d& p_O) {
    const Eigen::Vector3d beyond = p_O.cwiseAbs() - size / 2;
    return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0.0).norm();
  };
}

SurfaceDistance MakeFieldDistance(std::shared_ptr<const SignedDistanceField> field) {
  return
      [field = std::move(field)](const Eigen::Vector3d& p_O) { return field->Query(p_O).distance; };
}

namespace {

using Column = Eigen::Index;

constexpr size_t kMinTrialSamples = 10;

[[noreturn]] void Refuse(const std::string& text) {
  throw Error(ErrorKind::kRange, "this trial cannot be analysed: " + text);
}

void CheckTrack(const ReachTrial& trial, const Trajectory& track, const std::string& name) {
  if (track.times == trial.times && track.states.size() == trial.times.size() &&
      track.p.cols() == static_cast<Column>(trial.times.size())) {
    return;
  }
  Refuse("the track of " + name + " has " + std::to_string(track.size()) +
         " samples, the trial has " + std::to_string(trial.times.size()) +
         "; both must have the same times (resample them together)");
}

/** Its inverse, transposed, times its determinant. */
Eigen::Matrix3d CalcCofactors(const Eigen::Matrix3d& X) {
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = X.col(1).cross(X.col(2));
  cofactors.col(1) = X.col(2).cross(X.col(0));
  cofactors.col(2) = X.col(0).cross(X.col(1));
  return cofactors;
}

/** The nearest rotation, by Newton's iteration (Higham 1986, SIAM J. Sci. Stat. Comput. 7:1160), a
fifth of the time of a singular value decomposition, which singular axes have. */
Eigen::Matrix3d MakeOrthonormal(const Eigen::Matrix3d& axes) {
  constexpr double kClose = 1e-8;  // the error after a step is half its square
  constexpr int kMostSteps = 50;
  Eigen::Matrix3d X = std::sqrt(3.0) / axes.norm() * axes;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Matrix3d cofactors = CalcCofactors(X);
    const double determinant = X.col(0).dot(cofactors.col(0));
    if (!(std::abs(determinant) > 1e-12)) break;
    const Eigen::Matrix3d next = 0.5 * (X + cofactors / determinant);
    const double change = (next - X).norm();
    X = next;
    if (change < kClose) return X;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

using Places = Eigen::Ref<const Eigen::Matrix3Xd>;

/** Rigid motion that takes the places in O to where the markers were seen. */
Pose FitPose(const Places& p_OM, const Places& p_LM, const Eigen::Matrix3d& R_rest) {
  if (p_OM.cols() < 3) return MakePose(R_rest, (p_LM - R_rest * p_OM).rowwise().mean());
  const Eigen::Vector3d p_OC = p_OM.rowwise().mean(), p_LC = p_LM.rowwise().mean();
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (Column m = 0; m < p_OM.cols(); ++m) {
    H += (p_LM.col(m) - p_LC) * (p_OM.col(m) - p_OC).transpose();
  }
  // Markers in a plane leave a direction open, which the other two give, and so no mirror image.
  H += CalcCofactors(H) / H.norm();
  Pose X_LO;
  if (!(H.determinant() > 1e-9 * std::pow(H.norm(), 3))) {
    X_LO.matrix() = Eigen::umeyama(p_OM, p_LM, false);
    return X_LO;
  }
  const Eigen::Matrix3d R_LO = MakeOrthonormal(H);
  return MakePose(R_LO, p_LC - R_LO * p_OC);
}

void CheckSpread(const Eigen::Matrix3Xd& p_OM) {
  if (p_OM.cols() < 3) return;
  const Eigen::Matrix3Xd centred = p_OM.colwise() - p_OM.rowwise().mean();
  const Eigen::Vector3d squares =  // of the extents, the smallest first
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred * centred.transpose(),
                                                     Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (!(squares[1] > 1e-6 * squares[2])) {
    Refuse("the object's " + std::to_string(p_OM.cols()) +
           " markers lie on one line, so its turn about that line is not known; leave all but two "
           "of them out to go without its orientation");
  }
}

/** A point for every pose. */
template <class MakePoint>
Trajectory TakePath(const ReachTrial& trial, const MakePoint& make_point) {
  Trajectory path;
  path.times = trial.times;
  path.states = trial.object.states;
  path.p.resize(3, static_cast<Column>(trial.times.size()));
  for (size_t i = 0; i < trial.times.size(); ++i) {
    path.At(i) = make_point(trial.object.X_LO[i]);
  }
  return path;
}

/** NaN for a pose that is not known. */
Eigen::Vector3d CalcRotationVector(const Eigen::Matrix3d& R) {
  if (R.hasNaN()) return Eigen::Vector3d::Constant(std::nan(""));
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d CalcTurnLever(const Eigen::Matrix3Xd& p_OM) {
  if (p_OM.cols() < 3) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3Xd r = p_OM.colwise() - p_OM.rowwise().mean();
  const Eigen::Matrix3d spread = r * r.transpose();
  const Eigen::Matrix3d J = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J).operatorSqrt();
}

/** Principal axes of the turns within 0.1 s of each sample, as columns. */
std::vector<Eigen::Matrix3d> FindTurningAxes(const Eigen::Matrix3Xd& u, double interval) {
  constexpr double kReach = 0.1;  // [s]
  const auto reach = static_cast<Column>(std::lround(kReach / interval));
  std::vector<Eigen::Matrix3d> axes;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto add = [&](Column i, double sign) {
    if (i >= 0 && i < u.cols() && !u.col(i).hasNaN()) sum += sign * u.col(i) * u.col(i).transpose();
  };
  for (Column i = -reach; i < u.cols(); ++i) {
    add(i + reach, 1.0);
    add(i - reach - 1, -1.0);
    if (i < 0) continue;
    axes.push_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors());
  }
  return axes;
}

/** Turned back as far as noise may have turned it; see SmoothObject. */
Eigen::Matrix3d ShrinkTurn(const Eigen::Vector3d& u, const Eigen::Matrix3d& axes,
                           const Eigen::Matrix3d& lever, double noise) {
  constexpr double kRotationFactor = 4.0;
  Eigen::Vector3d parts = axes.transpose() * u;
  for (double& part : parts) {
    const double ratio = kRotationFactor * noise / std::abs(part);
    part *= ratio < 1.0 ? 1.0 - ratio * ratio : 0.0;  // 0 also for no turn at all
  }
  const Eigen::Vector3d w = lever.inverse() * (axes * parts);
  return MakeOrthonormal(Eigen::AngleAxisd(w.norm(), w.stableNormalized()).matrix());
}

}  // namespace

Trajectory TakeObjectPath(const ReachTrial& trial) {
  return TakePath(trial,
                  [&](const Pose& X_LO) { return Eigen::Vector3d(X_LO * trial.object.p_OC); });
}

void CheckTrial(const ReachTrial& trial) {
  if (trial.times.size() < kMinTrialSamples) {
    Refuse("it has " + std::to_string(trial.times.size()) + " samples; expected " +
           std::to_string(kMinTrialSamples) + " or more");
  }
  if (!FindSampling(trial.times).is_even) {
    Refuse("its samples are not evenly spaced; resample them");
  }
  if (trial.digits.size() < 2) {
    Refuse("it has " + std::to_string(trial.digits.size()) +
           " digits; a grasp needs two or more fingertip markers");
  }
  int num_thumbs = 0;
  for (const DigitTrack& digit : trial.digits) {
    num_thumbs += digit.is_thumb;
    CheckTrack(trial, digit.tip, "digit " + digit.digit);
    if (digit.force.times.size() != digit.force.values.size()) {
      Refuse("the force of digit " + digit.digit + " has " +
             std::to_string(digit.force.times.size()) + " times and " +
             std::to_string(digit.force.values.size()) + " values");
    }
  }
  if (num_thumbs > 1) Refuse("it has " + std::to_string(num_thumbs) + " thumbs");
  if (trial.wrist.size() > 0) CheckTrack(trial, trial.wrist, "the wrist");
  if (trial.object.IsRecorded() && (trial.object.X_LO.size() != trial.times.size() ||
                                    trial.object.states.size() != trial.times.size())) {
    Refuse("the object has " + std::to_string(trial.object.X_LO.size()) + " poses, the trial has " +
           std::to_string(trial.times.size()) + " samples");
  }
}

Eigen::Matrix3d MakeUprightOrientation(const Eigen::Vector3d& up_L) {
  const Eigen::Vector3d up = up_L.normalized();
  const Eigen::Vector3d forward =
      std::abs(up.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d R_LO;
  R_LO.col(0) = (forward - forward.dot(up) * up).normalized();
  R_LO.col(1) = up.cross(R_LO.col(0));
  R_LO.col(2) = up;
  return R_LO;
}

std::vector<Eigen::Vector3d> FindMarkerPlaces(const std::vector<Trajectory>& markers, double until,
                                              const Eigen::Vector3d& p_MO_L,
                                              const Eigen::Matrix3d& R_LO) {
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d origin = p_MO_L;
  for (size_t m = 0; m < markers.size(); ++m) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (size_t i = 0; i < markers[m].size() && markers[m].times[i] < until; ++i) {
      if (!markers[m].IsValid(i)) continue;
      sum += markers[m].At(i);
      count += 1.0;
    }
    if (count == 0.0) {
      throw Error(ErrorKind::kFormat, "marker " + std::to_string(m + 1) +
                                          " of the object is not seen while the object rests, so "
                                          "its place on the object is not known");
    }
    places.push_back(sum / count);
    origin += places.back() / static_cast<double>(markers.size());
  }
  for (Eigen::Vector3d& place : places) place = R_LO.transpose() * (place - origin);
  return places;
}

ObjectTrack MakeObjectTrack(const std::vector<Trajectory>& markers,
                            const std::vector<Eigen::Vector3d>& p_OM, const Eigen::Matrix3d& R_LO) {
  GRASPBENCH_DEMAND(!markers.empty() && markers.size() == p_OM.size(),
                    std::to_string(markers.size()) + ", " + std::to_string(p_OM.size()));
  Eigen::Matrix3Xd all_places(3, static_cast<Column>(p_OM.size()));
  for (size_t m = 0; m < p_OM.size(); ++m) all_places.col(static_cast<Column>(m)) = p_OM[m];
  CheckSpread(all_places);

  const size_t num_needed = std::min<size_t>(markers.size(), 3);
  ObjectTrack track;
  track.p_OC = all_places.rowwise().mean();
  track.turn_lever = CalcTurnLever(all_places);
  Eigen::Matrix3Xd places(3, all_places.cols()), seen(3, all_places.cols());
  for (size_t i = 0; i < markers[0].size(); ++i) {
    Column count = 0;
    SampleState state = SampleState::kMeasured;
    for (size_t m = 0; m < markers.size(); ++m) {
      if (!markers[m].IsValid(i)) continue;
      if (markers[m].states[i] == SampleState::kFilled) state = SampleState::kFilled;
      places.col(count) = p_OM[m];
      seen.col(count++) = markers[m].At(i);
    }
    if (static_cast<size_t>(count) < num_needed) {
      track.X_LO.push_back(MakePose(Eigen::Vector3d::Constant(std::nan(""))));
      track.states.push_back(SampleState::kInvalid);
      continue;
    }
    track.X_LO.push_back(FitPose(places.leftCols(count), seen.leftCols(count), R_LO));
    track.states.push_back(state);
  }
  return track;
}

Eigen::Matrix3d FindRestingOrientation(const ObjectTrack& object) {
  const size_t num_rest = std::max<size_t>(1, object.X_LO.size() / 10);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < object.X_LO.size(); ++i) {
    if (i >= num_rest && !sum.isZero()) break;
    if (object.states[i] != SampleState::kInvalid) sum += object.X_LO[i].linear();
  }
  return sum.isZero() ? Eigen::Matrix3d::Identity() : MakeOrthonormal(sum);
}

ObjectTrack SmoothObject(const ReachTrial& trial, double cutoff, double turn_cutoff) {
  ObjectTrack smooth = trial.object;
  const SmoothPath middle = Smooth(TakeObjectPath(trial), cutoff);
  smooth.smooth_noise = middle.smooth_noise;
  const bool turns = !smooth.turn_lever.isZero();
  const Eigen::Matrix3d R_rest = FindRestingOrientation(trial.object);
  Eigen::Matrix3Xd u(3, static_cast<Column>(trial.times.size()));
  std::vector<Eigen::Matrix3d> turning_axes;
  double noise = 0.0;
  if (turns) {
    const auto calc_u = [&](const Eigen::Matrix3d& R) -> Eigen::Vector3d {
      return smooth.turn_lever * CalcRotationVector(R_rest.transpose() * R);
    };
    std::array<Trajectory, 3> axes;
    for (int k = 0; k < 3; ++k) {
      axes[k] = TakePath(trial, [k](const Pose& X_LO) { return X_LO.linear().col(k); });
      FilterLowPass(axes[k], turn_cutoff);
    }
    for (Column i = 0; i < u.cols(); ++i) {
      Eigen::Matrix3d R;
      for (int k = 0; k < 3; ++k) R.col(k) = axes[k].p.col(i);
      u.col(i) = smooth.states[static_cast<size_t>(i)] == SampleState::kInvalid
                     ? Eigen::Vector3d::Constant(std::nan(""))
                     : calc_u(MakeOrthonormal(R));
    }
    noise = Smooth(TakePath(trial, [&](const Pose& X_LO) { return calc_u(X_LO.linear()); }),
                   turn_cutoff)
                .smooth_noise;
    turning_axes = FindTurningAxes(u, trial.times[1] - trial.times[0]);
  }
  for (size_t i = 0; i < trial.times.size(); ++i) {
    if (smooth.states[i] == SampleState::kInvalid) continue;
    const auto column = static_cast<Column>(i);
    Eigen::Matrix3d R = R_rest;
    if (turns) R *= ShrinkTurn(u.col(column), turning_axes[i], smooth.turn_lever, noise);
    smooth.X_LO[i].linear() = R;
    smooth.X_LO[i].translation() = middle.path.p.col(column) - R * smooth.p_OC;
  }
  return smooth;
}

}  // namespace graspbench
