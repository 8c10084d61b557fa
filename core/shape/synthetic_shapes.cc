#include "core/shape/synthetic_shapes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

enum class Family { kSphere, kBox, kCylinder, kRod, kRing, kBulb, kCross };
constexpr const char* kFamilyNames[] = {"sphere", "box",  "cylinder", "rod",
                                        "ring",   "bulb", "cross"};

constexpr const char* kUseNames[] = {"training", "validation", "benchmark"};

/** Sizes in mm; for a sphere, a cylinder and a ring the length equals the width. */
struct ShapeRow {
  const char* grasp;
  Family family;
  DrawnRange length_mm, width_mm, height_mm, density;
  Approach approach = Approach::kAutomatic;
};
// Each grasp's rows are used in turn. Densities refer to the outer volume, so hollow objects are
// light [kg/m^3].
constexpr ShapeRow kShapes[] = {
    {"g1", Family::kBox, {60, 160}, {28, 52}, {18, 34}, {200, 700}},
    {"g1", Family::kCylinder, {}, {30, 48}, {35, 60}, {150, 800}},
    {"g1", Family::kSphere, {}, {36, 50}, {}, {300, 1200}},
    {"g1", Family::kCylinder, {}, {32, 55}, {13, 22}, {300, 900}},
    {"g1", Family::kBox, {70, 200}, {14, 26}, {30, 42}, {300, 900}},
    {"g1", Family::kBox, {50, 90}, {30, 46}, {40, 60}, {100, 400}},
    {"g2", Family::kRod, {110, 180}, {8, 20}, {}, {300, 900}},
    {"g2", Family::kBox, {28, 40}, {24, 36}, {26, 38}, {200, 700}},
    {"g2", Family::kBox, {45, 70}, {28, 42}, {11, 17}, {200, 600}},
    {"g2", Family::kBox, {35, 60}, {8, 14}, {18, 30}, {400, 1300}},
    {"g2", Family::kRod, {140, 190}, {6, 9}, {}, {400, 900}},
    {"g2", Family::kSphere, {}, {24, 36}, {}, {200, 900}},
    {"g3", Family::kCylinder, {}, {45, 84}, {72, 125}, {200, 800}, Approach::kSide},
    {"g3", Family::kSphere, {}, {62, 84}, {}, {80, 400}, Approach::kSide},
    {"g3", Family::kBox, {44, 72}, {42, 66}, {75, 120}, {150, 500}, Approach::kSide},
    {"g3", Family::kCylinder, {}, {42, 66}, {95, 140}, {300, 900}, Approach::kSide},
    {"g3", Family::kCylinder, {}, {60, 84}, {75, 110}, {150, 600}, Approach::kSide},
    {"g4", Family::kRod, {120, 180}, {6, 10}, {}, {400, 900}},
    {"g4", Family::kBox, {40, 70}, {7, 13}, {18, 32}, {400, 1200}},
    {"g4", Family::kRod, {110, 160}, {12, 20}, {}, {300, 700}},
    {"g4", Family::kBox, {40, 60}, {18, 26}, {10, 16}, {300, 900}},
    {"g5", Family::kBox, {28, 40}, {28, 40}, {34, 56}, {200, 700}},
    {"g5", Family::kCylinder, {}, {34, 52}, {14, 24}, {300, 800}},
    {"g5", Family::kSphere, {}, {36, 60}, {}, {150, 700}},
    {"g5", Family::kBox, {60, 120}, {30, 46}, {20, 36}, {200, 600}},
    {"g5", Family::kCylinder, {}, {36, 56}, {40, 70}, {150, 600}},
    {"g5", Family::kCross, {}, {50, 95}, {20, 55}, {100, 400}},
    {"g6", Family::kSphere, {}, {56, 76}, {}, {80, 450}},
    {"g6", Family::kCylinder, {}, {58, 78}, {85, 125}, {500, 1000}},
    {"g6", Family::kRing, {}, {54, 72}, {20, 34}, {300, 700}},
    {"g6", Family::kCylinder, {}, {65, 90}, {50, 80}, {300, 800}},
    {"g6", Family::kRod, {80, 130}, {50, 66}, {}, {80, 400}},
    {"g6", Family::kBox, {60, 110}, {50, 66}, {45, 75}, {150, 500}},
    {"g6", Family::kBulb, {85, 120}, {48, 66}, {}, {80, 300}},
    {"g6", Family::kCylinder, {}, {56, 74}, {95, 140}, {400, 1000}, Approach::kSide},
    {"g6", Family::kSphere, {}, {58, 80}, {}, {80, 400}, Approach::kSide},
    {"g6", Family::kCylinder, {}, {50, 80}, {70, 110}, {200, 800}, Approach::kSide},
};
constexpr DrawnRange kFriction = {0.25, 0.5};  ///< static
constexpr double kDynamicShare = 0.85;         ///< of static friction
constexpr double kEdge = 0.0008;               ///< edge radius of boxes [m]
constexpr double kFlatSpot = 0.001;            ///< cut off a sphere's bottom [m]
constexpr double kLikeAJudge = 0.002;  ///< objects are alike if no dimension differs more [m]
constexpr double kHole = 0.7;          ///< of a ring's width
constexpr double kNeck = 0.45;         ///< of a bulb's width
constexpr double kBelt = 0.2;          ///< half the latitude range of a bulb's widest part [rad]
constexpr double kArm = 0.3;           ///< of a cross's width

TriMesh MakeFlatSphere(double diameter) {
  constexpr int kSteps = 20;
  const double radius = 0.5 * diameter;
  const double bottom = kFlatSpot - radius;
  std::vector<Vector2d> profile = {{0.0, bottom}};
  const double first = std::asin(bottom / radius);
  for (int k = 0; k < kSteps; ++k) {
    const double latitude = first + (0.5 * kPi - first) * k / kSteps;
    profile.emplace_back(radius * std::cos(latitude), radius * std::sin(latitude));
  }
  profile.emplace_back(0.0, radius);
  return MakeRevolution(profile, 40);
}

TriMesh MakeRod(double length, double width) {
  constexpr int kSides = 24;
  std::vector<Ring> rings(2);
  for (int end = 0; end < 2; ++end) {
    for (int k = 0; k < kSides; ++k) {
      // A side, not an edge, lies on the table; with this radius the sides are at half the width.
      const double angle = 2.0 * kPi * (k + 0.5) / kSides;
      const double radius = 0.5 * width / std::cos(kPi / kSides);
      rings[end].emplace_back((end - 0.5) * length, radius * std::cos(angle),
                              radius * std::sin(angle));
    }
  }
  return MakeLoft(rings);
}

/** A body of revolution about x, with the neck at the lower end and the ball at the upper one. It
lies on a side of the belt around the ball. */
TriMesh MakeBulb(double length, double width) {
  constexpr int kSides = 24, kSteps = 24;
  const double radius = 0.5 * width;
  const double neck = kNeck * radius;
  const double centre = 0.5 * length - radius;
  const double first = -std::acos(neck / radius);  // where the neck meets the ball
  std::vector<Vector2d> profile = {{0.0, -0.5 * length}, {neck, -0.5 * length}};
  for (int k = 0; k < kSteps; ++k) {
    const double latitude = first + (0.5 * kPi - first) * k / kSteps;
    const bool is_belt = std::abs(latitude) < kBelt;
    profile.emplace_back(is_belt ? radius : radius * std::cos(latitude),
                         centre + radius * std::sin(latitude));
  }
  profile.emplace_back(0.0, 0.5 * length);
  TriMesh mesh = MakeRevolution(profile, kSides);
  const double turn = kPi / kSides, stretch = 1.0 / std::cos(turn);  // as for a rod
  for (Vector3d& p : mesh.vertices) {
    p = Vector3d(p.z(), stretch * (p.x() * std::cos(turn) - p.y() * std::sin(turn)),
                 stretch * (p.x() * std::sin(turn) + p.y() * std::cos(turn)));
  }
  return mesh;
}

TriMesh MakeCross(double width, double height) {
  const double tip = 0.5 * width, arm = 0.5 * kArm * width;
  std::vector<Ring> rings(2);
  for (int end = 0; end < 2; ++end) {
    const double z = (end - 0.5) * height;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double c = quarter == 0 ? 1.0 : quarter == 2 ? -1.0 : 0.0;
      const double s = quarter == 1 ? 1.0 : quarter == 3 ? -1.0 : 0.0;
      for (const Vector2d& p : {Vector2d(tip, -arm), Vector2d(tip, arm), Vector2d(arm, arm)}) {
        rings[end].emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y(), z);
      }
    }
  }
  return MakeLoft(rings);
}

TriMesh MakeRingShape(double width, double height) {
  constexpr int kSides = 48;
  const double corners[4][2] = {{1.0, -0.5}, {1.0, 0.5}, {kHole, 0.5}, {kHole, -0.5}};
  std::vector<Ring> rings;
  for (const auto& [radius, z] : corners) {
    Ring ring;
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * kPi * k / kSides;
      ring.emplace_back(0.5 * width * radius * std::cos(angle),
                        0.5 * width * radius * std::sin(angle), z * height);
    }
    rings.push_back(ring);
  }
  return MakeLoft(rings, LoftEnds::kJoined);
}

TriMesh MakeShapeMesh(Family family, const Vector3d& size) {
  const double radius = 0.5 * size.y();
  switch (family) {
    case Family::kSphere:
      return MakeFlatSphere(size.y());
    case Family::kBox:
      return MakeRoundedBox(size, kEdge, 2);
    case Family::kCylinder:
      return MakeRevolution({{0.0, -0.5 * size.z()},
                             {radius, -0.5 * size.z()},
                             {radius, 0.5 * size.z()},
                             {0.0, 0.5 * size.z()}},
                            48);
    case Family::kRod:
      return MakeRod(size.x(), size.y());
    case Family::kBulb:
      return MakeBulb(size.x(), size.y());
    case Family::kCross:
      return MakeCross(size.y(), size.z());
    case Family::kRing:
      break;
  }
  return MakeRingShape(size.y(), size.z());
}

Vector3d DrawSize(const ShapeRow& row, double largest, RandomStream& stream) {
  Vector3d size(MFromMm(row.length_mm.Draw(stream)), MFromMm(row.width_mm.Draw(stream)),
                MFromMm(row.height_mm.Draw(stream)));
  if (row.length_mm.high > 0.0 && size.x() < size.y()) std::swap(size.x(), size.y());
  if (size.y() > largest) size *= largest / size.y();
  if (row.length_mm.high == 0.0) size.x() = size.y();
  if (row.height_mm.high == 0.0) size.z() = size.y();
  return size;
}

/** Draws until the size is no judge's; after some hundred draws it is taken as it is: a tiny hand's
shapes are all alike. */
Vector3d DrawOtherSize(const ShapeRow& row, double largest, const std::vector<Vector3d>& judges,
                       RandomStream& stream) {
  constexpr int kMostDraws = 200;
  Vector3d size = DrawSize(row, largest, stream);
  const auto is_judge = [&](const Vector3d& judge) {
    return (size - judge).cwiseAbs().maxCoeff() < kLikeAJudge;
  };
  for (int k = 0; k < kMostDraws && std::any_of(judges.begin(), judges.end(), is_judge); ++k) {
    size = DrawSize(row, largest, stream);
  }
  return size;
}

std::shared_ptr<const GraspObject> MakeShape(const ShapeRow& row, const std::string& id,
                                             const Vector3d& size, RandomStream& stream) {
  const double density = row.density.Draw(stream);
  const double friction = kFriction.Draw(stream);
  auto object = std::make_shared<GraspObject>();
  object->id = id;
  object->mesh = MakeShapeMesh(row.family, size);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : object->mesh.vertices) box.extend(p);
  for (Vector3d& p : object->mesh.vertices) p -= box.center();
  object->size = box.sizes();
  const double mass = density * CalcVolume(object->mesh);
  object->mass_properties = CalcSolidMassProperties(object->mesh, mass);
  // Moves the centre of mass to the middle of the ball: a solid bulb would tip.
  if (row.family == Family::kBulb) {
    object->mass_properties.p_OOcm.x() = 0.5 * (object->size.x() - object->size.y());
  }
  object->surface.friction_static = friction;
  object->surface.friction_dynamic = kDynamicShare * friction;
  object->approach = row.approach;
  object->name =
      fmt::format("{}, {:.0f} x {:.0f} x {:.0f} mm, {:.0f} g",
                  kFamilyNames[static_cast<size_t>(row.family)], MmFromM(object->size.x()),
                  MmFromM(object->size.y()), MmFromM(object->size.z()), GFromKg(mass));
  object->content_hash = CalcHashHex(fmt::format("{} {:a} {:a} {:a} {:a} {:a}", object->name,
                                                 size.x(), size.y(), size.z(), mass, friction));
  return object;
}

}  // namespace

std::vector<std::shared_ptr<const GraspObject>> MakeShapes(const std::string& grasp, ShapeUse use,
                                                           int seed, int count, double largest,
                                                           const std::vector<Vector3d>& judges) {
  std::vector<const ShapeRow*> rows;
  for (const ShapeRow& row : kShapes) {
    if (grasp == row.grasp) rows.push_back(&row);
  }
  GRASPBENCH_DEMAND(!rows.empty() && largest > 0.0, grasp);
  const std::string name = kUseNames[static_cast<size_t>(use)];
  std::vector<std::shared_ptr<const GraspObject>> shapes;
  for (int k = 0; k < count; ++k) {
    const ShapeRow& row = *rows[static_cast<size_t>(k) % rows.size()];
    RandomStream stream(fmt::format("{} {} {}", seed, grasp, k), name + " shape");
    const Vector3d size = DrawOtherSize(row, largest, judges, stream);
    shapes.push_back(MakeShape(row, fmt::format("{}-{}-{}", name, grasp, k), size, stream));
  }
  return shapes;
}

}  // namespace graspbench
