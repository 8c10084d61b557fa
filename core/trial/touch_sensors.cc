#include "core/trial/touch_sensors.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kPatchForce = 5.0;      // at which a patch has its nominal radius [N]
constexpr double kTouchForce = 0.1;      // at which a touch should be felt [N]
constexpr double kInTime = 0.01;         // [s]
constexpr double kOnSurface = 0.001;     // from the nearest point: more than half their spacing [m]
constexpr double kRoundPeak = 1000.0;    // to mN
constexpr double kTimeTolerance = 1e-9;  // of sums of steps [s]

double CalcFullResponse(const SensorConfig& config) {
  return 1.0 - std::exp(-config.saturation / config.force_scale);
}

}  // namespace

bool SpreadForce(const SensedSurface& surface, const Vector3d& p_L, double force,
                 double patch_radius, std::vector<double>& forces) {
  std::vector<double> squares;  // squared distances from the position [m^2]
  squares.reserve(surface.points.size());
  for (const SurfacePoint& point : surface.points) {
    squares.push_back((point.p_L - p_L).squaredNorm());
  }
  const auto least = std::min_element(squares.begin(), squares.end());
  if (!(*least <= kOnSurface * kOnSurface)) return false;
  const double a = patch_radius * std::cbrt(force / kPatchForce);
  std::vector<std::pair<size_t, double>> pressed;  // element, weight
  double sum = 0.0;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    if (!(squares[i] < a * a)) continue;
    const SurfacePoint& point = surface.points[i];
    pressed.emplace_back(static_cast<size_t>(point.element),
                         point.area * std::sqrt(1.0 - squares[i] / (a * a)));
    sum += pressed.back().second;
  }
  if (pressed.empty()) {  // patch smaller than the spacing of the points
    const auto nearest = static_cast<size_t>(least - squares.begin());
    forces[static_cast<size_t>(surface.points[nearest].element)] += force;
  }
  for (const auto& [element, weight] : pressed) forces[element] += force * weight / sum;
  return true;
}

double CalcReading(TactileResponse response, const SensorConfig& config, double force) {
  const double x = std::min(force, config.saturation);
  if (response == TactileResponse::kLinear) return x / config.saturation;
  return (1.0 - std::exp(-x / config.force_scale)) / CalcFullResponse(config);
}

double CalcForce(TactileResponse response, const SensorConfig& config, double reading) {
  const double share = std::clamp(reading, 0.0, 1.0);
  if (response == TactileResponse::kLinear) return share * config.saturation;
  return -config.force_scale * std::log1p(-share * CalcFullResponse(config));
}

TouchSensors::TouchSensors(const Hand& hand, const SensorConfig& config, const std::string& id)
    : hand_(&hand),
      skin_(hand.skin),
      config_(config),
      noise_(id, "touch noise"),
      forces_(hand.skin->elements.size(), 0.0),
      remembered_(forces_),
      readings_(forces_),
      sensed_(hand.links.size(), 0.0),
      elsewhere_(sensed_),
      touches_(hand.links.size()),
      has_felt_(hand.digits.size(), false) {
  record_.peak = forces_;
}

bool TouchSensors::Press(const HandContact& contact, const HandDynamics& dynamics) {
  const auto link = static_cast<size_t>(contact.link);
  if (const SensedSurface* surface = skin_->FindSurface(contact.link)) {
    const Vector3d p_L = ProjectOntoSurface(*hand_, contact.link,
                                            dynamics.X_WL(contact.link).inverse() * contact.p_WC);
    if (SpreadForce(*surface, p_L, contact.normal_force, config_.patch_radius, forces_)) {
      sensed_[link] += contact.normal_force;
      return true;
    }
  }
  elsewhere_[link] += contact.normal_force;
  return false;
}

void TouchSensors::Sample() {
  for (size_t i = 0; i < forces_.size(); ++i) {
    remembered_[i] =
        std::clamp(remembered_[i], forces_[i], forces_[i] / (1.0 - config_.hysteresis));
    readings_[i] =
        CalcReading(skin_->response, config_, remembered_[i]) + config_.noise * noise_.NextNormal();
    if (readings_[i] <= config_.threshold) continue;
    const int digit = hand_->FindDigitOfLink(skin_->elements[i].link);
    if (digit >= 0) has_felt_[static_cast<size_t>(digit)] = true;
  }
}

bool TouchSensors::IsFelt(int link) const {
  for (size_t i = 0; i < readings_.size(); ++i) {
    if (skin_->elements[i].link == link && readings_[i] > config_.threshold) return true;
  }
  return false;
}

void TouchSensors::FollowTouches(double time) {
  for (size_t i = 0; i < touches_.size(); ++i) {
    LinkTouch& touch = touches_[i];
    if (!touch.is_elsewhere && elsewhere_[i] > kTouchForce) ++record_.num_elsewhere;
    touch.is_elsewhere = elsewhere_[i] > (touch.is_elsewhere ? 0.0 : kTouchForce);
    if (!touch.is_touching && sensed_[i] > kTouchForce) {
      ++record_.num_touches;
      touch.waits_since = time;
    }
    touch.is_touching = sensed_[i] > (touch.is_touching ? 0.0 : kTouchForce);
    if (std::isnan(touch.waits_since)) continue;
    if (IsFelt(static_cast<int>(i))) {
      const double delay = time - touch.waits_since;
      ++(delay <= kInTime + kTimeTolerance ? record_.num_felt_in_time : record_.num_felt_late);
      record_.longest_delay = std::max(record_.longest_delay, delay);
      touch.waits_since = kUnset;
    } else if (!touch.is_touching) {
      touch.waits_since = kUnset;  // it was never felt
    }
  }
}

void TouchSensors::Observe(double time, const std::vector<HandContact>& contacts,
                           const HandDynamics& dynamics) {
  time_ = time;
  for (std::vector<double>* of : {&forces_, &sensed_, &elsewhere_}) {
    std::fill(of->begin(), of->end(), 0.0);
  }
  on_elements_.clear();
  for (const HandContact& contact : contacts) on_elements_.push_back(Press(contact, dynamics));
  for (size_t i = 0; i < forces_.size(); ++i) {
    record_.peak[i] = std::max(record_.peak[i], std::round(kRoundPeak * forces_[i]) / kRoundPeak);
  }
  if (time >= next_sample_ - kTimeTolerance) {
    Sample();
    next_sample_ += 1.0 / config_.rate;
  }
  FollowTouches(time);
}

double TouchSensors::CalcElementForce(size_t element) const {
  const double reading = readings_[element];
  return reading > config_.threshold ? CalcForce(skin_->response, config_, reading) : 0.0;
}

double TouchSensors::CalcFeltForce(std::optional<int> digit) const {
  double sum = 0.0;
  for (size_t i = 0; i < readings_.size(); ++i) {
    if (digit && hand_->FindDigitOfLink(skin_->elements[i].link) != *digit) continue;
    sum += CalcElementForce(i);
  }
  return sum;
}

double TouchSensors::CalcLinkForce(int link) const {
  double sum = 0.0;
  for (size_t i = 0; i < readings_.size(); ++i) {
    if (skin_->elements[i].link == link) sum += CalcElementForce(i);
  }
  return sum;
}

bool TouchSensors::IsSaturated(int link) const {
  for (size_t i = 0; i < readings_.size(); ++i) {
    if (skin_->elements[i].link == link && readings_[i] >= 1.0) return true;
  }
  return false;
}

}  // namespace graspbench
