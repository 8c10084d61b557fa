#include "core/vision/camera_config.h"

#include <cstddef>

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d Distort(const Lens& lens, const Vector2d& p) {
  const double r2 = p.squaredNorm(), xy = p.x() * p.y();
  const double s = 1.0 + r2 * (lens.k1 + r2 * lens.k2);
  return s * p + Vector2d(2.0 * lens.p1 * xy + lens.p2 * (r2 + 2.0 * p.x() * p.x()),
                          lens.p1 * (r2 + 2.0 * p.y() * p.y()) + 2.0 * lens.p2 * xy);
}

}  // namespace

std::optional<Eigen::Vector3f> ParseColour(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos) {
    return std::nullopt;
  }
  Eigen::Vector3f colour;
  for (size_t i = 0; i < 3; ++i) {
    colour[i] = static_cast<float>(std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16)) / 255.0f;
  }
  return colour;
}

Vector2d Project(const Lens& lens, const Vector3d& p_K) {
  const Vector2d p = Distort(lens, p_K.head<2>() / p_K.z());
  return Vector2d(lens.focal_x * p.x() + lens.centre_x, lens.focal_y * p.y() + lens.centre_y);
}

Vector3d CalcRay(const Lens& lens, const Vector2d& pixel) {
  const Vector2d wanted((pixel.x() - lens.centre_x) / lens.focal_x,
                        (pixel.y() - lens.centre_y) / lens.focal_y);
  Vector2d p = wanted;
  constexpr int kMaxSteps = 100;
  constexpr double kTolerance = 1e-12;
  for (int i = 0; lens.is_distorted() && i < kMaxSteps; ++i) {
    const Vector2d miss = wanted - Distort(lens, p);
    p += miss;
    if (miss.norm() < kTolerance) break;
  }
  return Vector3d(p.x(), p.y(), 1.0);
}

}  // namespace graspbench
