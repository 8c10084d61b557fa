#include "core/shape/synthetic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/shape/repair/mesh_check.h"
#include "tests/objects/catalogue_table.h"

namespace graspbench {
namespace {

constexpr const char* kGrasps[] = {"g1", "g2", "g3", "g4", "g5", "g6"};

/** Volume in closed form; of a box without its rounded edges, of round things of a circle. */
double CalcTrueVolume(const GraspObject& shape) {
  const Eigen::Vector3d& s = shape.size;
  const double circle = kPi / 4.0 * s.y() * s.y();
  if (shape.name.rfind("box", 0) == 0) return s.prod();
  if (shape.name.rfind("sphere", 0) == 0) return kPi / 6.0 * std::pow(s.y(), 3);
  if (shape.name.rfind("rod", 0) == 0) return circle * s.x();
  if (shape.name.rfind("ring", 0) == 0) return circle * s.z() * (1.0 - 0.7 * 0.7);
  if (shape.name.rfind("cross", 0) == 0) return s.y() * s.y() * s.z() * (2.0 * 0.3 - 0.3 * 0.3);
  if (shape.name.rfind("bulb", 0) == 0) {
    // The neck's cylinder up to where the ball is as wide, and the ball from there.
    const double radius = 0.5 * s.y(), neck = 0.45 * radius;
    const double below = std::sqrt(radius * radius - neck * neck);  // of the ball's middle
    const double ball = kPi * (2.0 / 3.0 * std::pow(radius, 3) + radius * radius * below -
                               std::pow(below, 3) / 3.0);
    return kPi * neck * neck * (s.x() - radius - below) + ball;
  }
  return circle * s.z();
}

TEST(SyntheticShapesTest, AreSolidsOfTheirKind) {
  for (const char* grasp : kGrasps) {
    for (const auto& shape : MakeShapes(grasp, ShapeUse::kTraining, 1, 12, 1.0, {})) {
      EXPECT_TRUE(CheckMesh(shape->mesh).problems.empty()) << shape->name;
      const double volume = CalcVolume(shape->mesh);
      EXPECT_NEAR(volume / CalcTrueVolume(*shape), 1.0, 0.025) << shape->name;
      const double density = shape->mass_properties.mass / volume;
      EXPECT_GE(density, 80.0) << shape->name;
      EXPECT_LE(density, 1300.0) << shape->name;
      EXPECT_LT(shape->surface.friction_dynamic, shape->surface.friction_static);
      EXPECT_GE(shape->size.x(), shape->size.y() - 1e-4) << shape->name;
      Eigen::Vector3d low = Eigen::Vector3d::Ones(), high = -low;
      int num_at_bottom = 0;
      for (const Eigen::Vector3d& p : shape->mesh.vertices) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        num_at_bottom += p.z() < -0.5 * shape->size.z() + 1e-6;
      }
      EXPECT_LT((low + high).norm(), 1e-9) << shape->name;
      EXPECT_LT((high - low - shape->size).norm(), 1e-9) << shape->name;
      EXPECT_GE(num_at_bottom, 4) << shape->name << " does not rest on a face";
    }
  }
}

// The claim on which every figure of a developed hand rests.
TEST(SyntheticShapesTest, NoneIsAnObjectOfTheBenchmark) {
  std::vector<Eigen::Vector3d> judges;
  for (const CatalogueRow& row : ListCatalogueRows()) {
    judges.emplace_back(MFromMm(row.length_mm), MFromMm(row.width_mm), MFromMm(row.height_mm));
  }
  for (int seed = 1; seed <= 10; ++seed) {
    for (const char* grasp : kGrasps) {
      for (const ShapeUse use :
           {ShapeUse::kTraining, ShapeUse::kValidation, ShapeUse::kBenchmark}) {
        for (const auto& shape : MakeShapes(grasp, use, seed, 12, 1.0, judges)) {
          for (const Eigen::Vector3d& judge : judges) {
            // 1 mm is cut off a sphere.
            EXPECT_GT((shape->size - judge).cwiseAbs().maxCoeff(), 0.00099)
                << shape->name << ", seed " << seed << ", and " << judge.transpose();
          }
        }
      }
    }
  }
}

// Else a bulb would tip over before the hand is there.
TEST(SyntheticShapesTest, AllStandOverWhatTheyRestOn) {
  for (const char* grasp : kGrasps) {
    for (const auto& shape : MakeShapes(grasp, ShapeUse::kTraining, 2, 12, 1.0, {})) {
      Eigen::Vector2d low = Eigen::Vector2d::Ones(), high = -low;
      for (const Eigen::Vector3d& p : shape->mesh.vertices) {
        if (p.z() > -0.5 * shape->size.z() + 1e-6) continue;
        low = low.cwiseMin(p.head<2>());
        high = high.cwiseMax(p.head<2>());
      }
      const Eigen::Vector2d p_OOcm = shape->mass_properties.p_OOcm.head<2>();
      EXPECT_GT((p_OOcm - low).minCoeff(), 0.0) << shape->name;
      EXPECT_GT((high - p_OOcm).minCoeff(), 0.0) << shape->name;
    }
  }
}

}  // namespace
}  // namespace graspbench
