#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <set>

#include "catalogue_table.h"
#include "core/base/units.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

TEST(LoadCatalogueTest, EveryObjectIsThatOfTheTable) {
  const std::vector<std::string> ids = ListObjects();
  ASSERT_EQ(ids.size(), ListCatalogueRows().size());
  std::set<std::string> hashes;
  for (size_t i = 0; i < ids.size(); ++i) {
    const CatalogueRow& row = ListCatalogueRows()[i];
    SCOPED_TRACE(row.id);
    EXPECT_EQ(ids[i], row.id);
    const auto object = LoadObject(row.id);
    const Eigen::Vector3d size_of_grasp = CalcSizeOfGrasp(*object);
    EXPECT_NEAR(MmFromM(size_of_grasp.x()), row.length_mm, 0.1);
    EXPECT_NEAR(MmFromM(size_of_grasp.y()), row.width_mm, 0.1);
    EXPECT_NEAR(MmFromM(size_of_grasp.z()), row.height_mm, 0.1);
    EXPECT_EQ(object->compressible.has_value(),
              row.id == "tissue_pack" || row.id == "paper_ball" || row.id == "chocolate_bar");
    EXPECT_NEAR(GFromKg(object->mass_properties.mass), row.mass_g, 1e-9);
    EXPECT_NEAR(MmFromM(object->mass_properties.p_OOcm.x()), row.offset_mm, 1e-9);
    EXPECT_EQ(object->surface.friction_static, row.friction_static);
    EXPECT_EQ(object->surface.friction_dynamic, row.friction_dynamic);

    // A rigid body's principal moments obey the triangle inequality.
    const Eigen::Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(object->mass_properties.I_OOcm)
            .eigenvalues();
    EXPECT_GT(moments[0], 0.0);
    EXPECT_LT(moments[2], moments[0] + moments[1]);

    // The field belongs to the mesh: zero on it, positive above it.
    double largest = 0.0;
    for (const Eigen::Vector3i& t : object->mesh.triangles) {
      const Eigen::Vector3d centre = (object->mesh.vertices[t[0]] + object->mesh.vertices[t[1]] +
                                      object->mesh.vertices[t[2]]) /
                                     3.0;
      largest = std::max(largest, std::abs(object->field->Query(centre).distance));
    }
    EXPECT_LT(largest, object->field->cell());
    EXPECT_NEAR(object->field->Query({0.0, 0.0, 0.5 * object->size.z() + 0.01}).distance, 0.01,
                row.id == "cup" || row.id == "adhesive_tape" ? 0.03 : 0.008);
    hashes.insert(object->content_hash);
  }
  EXPECT_EQ(hashes.size(), ids.size());
}

// A fingertip of 7 mm radius that went down as far as the surface yields at all, twice half of what
// the size loses, has not come to where the distance field's gradient turns: the gradient at its
// centre still points out of the face that it pressed.
TEST(LoadCatalogueTest, FingertipsStopBeforeTheMiddle) {
  for (const char* id : {"tissue_pack", "paper_ball", "chocolate_bar"}) {
    const auto object = LoadObject(id);
    for (int axis = 0; axis < 3; ++axis) {
      const double most = 2.0 * object->compressible->yield(axis, axis);
      for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector3d outwards = side * Eigen::Vector3d::Unit(axis);
        for (const double share : {0.5, 0.75, 1.0}) {
          const Eigen::Vector3d p_OCentre =
              (0.5 * object->size[axis] - share * most + 0.007) * outwards;
          EXPECT_GT(object->field->Query(p_OCentre).gradient.dot(outwards), 0.8)
              << id << ' ' << axis << ' ' << side << ' ' << share;
        }
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
