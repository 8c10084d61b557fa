#include <gtest/gtest.h>

#include "catalogue_table.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/shape/obj_file.h"
#include "core/shape/repair/mesh_check.h"
#include "objects/generate/object_shapes.h"
#include "objects/load_mesh.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

std::filesystem::path FindFolder(const std::string& id) {
  return FindDataRoot() / "objects" / "catalogue" / id;
}

TEST(GenerateMeshTest, TheCataloguesMeshesAreTheGeneratorsBytes) {
  for (const CatalogueRow& row : ListCatalogueRows()) {
    const ObjectFile file = LoadObjectFile(FindFolder(row.id) / "object.yaml");
    const std::string generated =
        FormatObj(GenerateMesh(row.id, file.size), UnitsPerMetre(file.mesh_unit));
    EXPECT_TRUE(generated == ReadFile(FindFolder(row.id) / file.mesh))
        << row.id << ": run generate_objects objects/catalogue";
  }
}

// The table has the sizes of grasp; a compressible object's mesh is that at rest.
TEST(GenerateMeshTest, EveryMeshIsASolidOfTheTablesSize) {
  for (const CatalogueRow& row : ListCatalogueRows()) {
    SCOPED_TRACE(row.id);
    const ObjectFile file = LoadObjectFile(FindFolder(row.id) / "object.yaml");
    const Eigen::Vector3d size_of_grasp =
        file.compression ? file.compression->size_of_grasp : file.size;
    const Eigen::Vector3d table_mm(row.length_mm, row.width_mm, row.height_mm);
    EXPECT_LT((1e3 * size_of_grasp - table_mm).cwiseAbs().maxCoeff(), 0.1);
    const MeshReport report = CheckMesh(LoadMesh(FindFolder(row.id) / "mesh.obj", LengthUnit::kMm));
    EXPECT_EQ(FormatProblems(report), "");
    EXPECT_TRUE(report.is_closed);
    EXPECT_GT(report.volume, 0.0);
    EXPECT_LE(report.num_triangles, 12000);
    EXPECT_LT((report.extent - file.size).cwiseAbs().maxCoeff(), 1e-4);
  }
}

// The bottom of every object, within 0.2 mm of the table, reaches around its centre of mass.
TEST(GenerateMeshTest, EveryObjectRestsStably) {
  for (const CatalogueRow& row : ListCatalogueRows()) {
    SCOPED_TRACE(row.id);
    const TriMesh mesh = LoadMesh(FindFolder(row.id) / "mesh.obj", LengthUnit::kMm);
    const Eigen::Vector2d centre_of_mass(MFromMm(row.offset_mm), 0.0);
    double bottom = 0.0;
    for (const Eigen::Vector3d& p : mesh.vertices) bottom = std::min(bottom, p.z());
    for (int i = 0; i < 32; ++i) {
      const double angle = 2.0 * kPi * i / 32;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      double reach = -1.0;
      for (const Eigen::Vector3d& p : mesh.vertices) {
        if (p.z() > bottom + 2e-4) continue;
        reach = std::max(reach, direction.dot(p.head<2>() - centre_of_mass));
      }
      EXPECT_GT(reach, 5e-4) << "towards " << DegFromRad(angle) << " deg";
    }
  }
}

}  // namespace
}  // namespace graspbench
