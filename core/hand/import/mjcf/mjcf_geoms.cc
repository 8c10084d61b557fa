#include "core/hand/import/mjcf/mjcf_geoms.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kGeomDensity = 1000.0;  // [kg/m^3], MuJoCo's default

}  // namespace

std::optional<ForeignShape::Weight> FindGeomWeight(MjcfDocument& document, const MjcfNode& node,
                                                   const std::string& where) {
  const MjcfSettings& settings = document.settings();
  const double group = document.FindNumber(node, "group", 0.0, where);
  if (settings.inertia_from_geom == MjcfSettings::GeomInertia::kNever ||
      group < settings.first_inertia_group || group > settings.last_inertia_group) {
    return {};
  }
  ForeignShape::Weight weight;
  if (const auto mass = document.FindNumbers(node, "mass", 1, 1, where)) weight.mass = (*mass)[0];
  weight.density = document.FindNumber(node, "density", kGeomDensity, where);
  if (weight.mass.value_or(weight.density) <= 0.0) return {};
  return weight;
}

bool ReadGeomFromTo(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape) {
  const auto ends = document.FindNumbers(node, "fromto", 6, 6, where);
  const auto size = document.FindNumbers(node, "size", 1, 3, where);
  if (!ends || !size) return false;
  const std::vector<double>& v = *ends;
  const Vector3d p_A(v[0], v[1], v[2]), p_B(v[3], v[4], v[5]), along = p_A - p_B;
  if (along.norm() < 1e-9) return false;
  shape.X_LS = MakePose(MakeRotationFromZ(along), 0.5 * (p_A + p_B));
  const double thick = 2.0 * (*size)[0];
  const bool has_ends = shape.kind == ForeignShape::Kind::kCapsule;
  shape.size = {thick, thick, along.norm() + (has_ends ? thick : 0.0)};
  return true;
}

bool ReadGeomExtent(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape) {
  using Kind = ForeignShape::Kind;
  const bool is_round = shape.kind == Kind::kCylinder || shape.kind == Kind::kCapsule;
  const size_t count = shape.kind == Kind::kSphere ? 1 : is_round ? 2 : 3;
  const auto size = document.FindNumbers(node, "size", count, 3, where);
  if (!size) return false;
  const std::vector<double>& v = *size;
  if (count == 1) {
    shape.size.setConstant(2.0 * v[0]);
  } else if (count == 2) {
    const double ends = shape.kind == Kind::kCapsule ? v[0] : 0.0;
    shape.size = {2.0 * v[0], 2.0 * v[0], 2.0 * (v[1] + ends)};
  } else {
    shape.size = {2.0 * v[0], 2.0 * v[1], 2.0 * v[2]};
  }
  return true;
}

}  // namespace graspbench
