#include "core/physics/known_answers/squeeze_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHeight = 1.0;

Hand MakeHand(const Squeeze& squeeze, double half_width) {
  Hand hand =
      MakeSqueezeHand(squeeze.num_fingers, half_width, squeeze.force, squeeze.torsion_radius);
  if (squeeze.pad.youngs_modulus == 0.0) return hand;
  for (HandLink& link : hand.links) {
    link.surface.pad = squeeze.pad;
    link.surface.torsion_radius = kUnset;
  }
  return hand;
}

GraspObject SetMaterial(GraspObject object, const Squeeze& squeeze) {
  const double scale = squeeze.mass / object.mass_properties.mass;
  object.mass_properties.mass = squeeze.mass;
  object.mass_properties.I_OOcm *= scale;
  object.surface.friction_static = object.surface.friction_dynamic = squeeze.mu;
  return object;
}

SimConfig MakeConfig(const Squeeze& squeeze) {
  SimConfig config;
  config.step = squeeze.step;
  return config;
}

}  // namespace

SqueezeScene::SqueezeScene(const Squeeze& squeeze, GraspObject object, double half_width)
    : world_(MakeHand(squeeze, half_width), SetMaterial(std::move(object), squeeze),
             MakeConfig(squeeze)) {
  world_.start().X_WH = MakePose(Vector3d(0.0, squeeze.off_centre, kHeight + kSqueezeLever));
  world_.start().p_WOcm = Vector3d(0.0, 0.0, kHeight);
  world_.start().gravity_W.setZero();
  world_.Reset(Eigen::VectorXd::Ones(squeeze.num_fingers));
  world_.Run(0.3);
  world_.RampGravity(Vector3d(0.0, 0.0, -kStandardGravity), 0.3);
}

double SqueezeScene::CalcFall() const { return kHeight - world_.state().p_WOcm.z(); }

double SqueezeScene::CalcTilt() const {
  return std::abs(std::asin(std::clamp(world_.state().R_WO(2, 1), -1.0, 1.0)));
}

double FindThreshold(double low, double high, const std::function<bool(double)>& holds) {
  const bool holds_at_low = holds(low);
  if (holds(high) == holds_at_low) return std::nan("");
  while (high - low > 0.002 * std::abs(high)) {
    const double middle = 0.5 * (low + high);
    (holds(middle) == holds_at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace graspbench
