#include "core/hand/contact_shape.h"

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

// Distance of neighbouring balls in radii; the surface dips by r - sqrt(r^2 - (d/2)^2).
constexpr double kSpacing = 1.5;
constexpr double kPadSpacing = 0.8;

/** Positions along [-half, half], symmetric, at most `spacing` apart. */
std::vector<double> Spread(double half, double spacing) {
  const int num_gaps = static_cast<int>(std::ceil(2.0 * half / spacing - 1e-9));
  if (num_gaps <= 0) return {0.0};
  std::vector<double> positions;
  for (int i = 0; i <= num_gaps; ++i) positions.push_back(half * (2.0 * i / num_gaps - 1.0));
  return positions;
}

/** Rows of balls along the axis `along`, side by side along the axis `wide`, in the middle plane.
 */
void AddRows(const CollisionShape& shape, double radius, int along, int wide, bool is_pad,
             Hand& hand) {
  const double spacing = (is_pad ? kPadSpacing : kSpacing) * radius;
  const double half_along = shape.size[along] / 2.0 - radius;
  for (double across : Spread(shape.size[wide] / 2.0 - radius, spacing)) {
    const auto place = [&](double position) -> Eigen::Vector3d {
      Eigen::Vector3d p_SP = Eigen::Vector3d::Zero();
      p_SP[wide] = across;
      p_SP[along] = position;
      return shape.X_LS * p_SP;
    };
    for (double position : Spread(half_along, spacing)) {
      hand.contact_spheres.push_back({shape.link, place(position), radius});
    }
    if (shape.is_cover) continue;
    hand.capsules.push_back({shape.link, place(-half_along), place(half_along), radius});
  }
}

}  // namespace

void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand) {
  const bool is_disc =
      shape.kind == CollisionShape::Kind::kCylinder && shape.size.z() < shape.size.x();
  if (is_disc || shape.kind == CollisionShape::Kind::kBox) {
    CollisionShape box = shape;
    if (is_disc) box.size.head<2>() *= std::sqrt(kPi) / 2.0;
    int thin, along;
    const double thickness = box.size.minCoeff(&thin);
    box.size.maxCoeff(&along);
    if (along == thin) along = (thin + 1) % 3;  // a cube
    AddRows(box, thickness / 2.0, along, 3 - thin - along, is_pad, hand);
  } else {
    AddRows(shape, shape.size.x() / 2.0, 2, 0, is_pad, hand);
  }
}

}  // namespace graspbench
