#include "core/hand/generate/hand_visuals.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/files/files.h"
#include "core/shape/mass_properties.h"
#include "core/shape/obj_file.h"

namespace graspbench {
namespace {

TEST(HandVisualsTest, TheFilesAreThoseThatTheGeneratorMakes) {
  for (const auto& [name, mesh] : MakeHandVisuals()) {
    EXPECT_TRUE(ReadFile(FindDataRoot() / "core" / "hand" / "models" / name) == FormatObj(mesh))
        << name << ": run generate_hand_visuals core/hand/models";
  }
}

TEST(HandVisualsTest, EveryMeshIsClosedAndOutward) {
  for (const auto& [name, mesh] : MakeHandVisuals()) {
    std::map<std::pair<int, int>, int> edges;  // directed; a closed surface has each both ways
    for (const Eigen::Vector3i& t : mesh.triangles) {
      for (int i = 0; i < 3; ++i) {
        ++edges[{t[i], t[(i + 1) % 3]}];
        --edges[{t[(i + 1) % 3], t[i]}];
      }
    }
    for (const auto& [edge, count] : edges) ASSERT_EQ(count, 0) << name;
    EXPECT_GT(CalcVolume(mesh), 0.0) << name;
  }
}

}  // namespace
}  // namespace graspbench
