#include "datasets/gltf/glb_file.h"

#include <cmath>

#include "core/shape/primitives.h"
#include "tests/datasets/gltf/read_glb.h"

namespace graspbench {

namespace {

TEST(GlbFile, GivesBackWhatWasAdded) {
  GlbFile file;
  const std::vector<double> bytes = {-127, 0, 127, 1, -2, 3}, shorts = {-32767, 5, 32767},
                            indices = {0, 65534, 7}, many = {0, 4000000000.0},
                            floats = {0.1, -2.5e-7, 3e4, 0.0};
  const int a = file.AddAccessor({GltfComponent::kByte, "VEC3", true, false, true}, bytes);
  const int b = file.AddAccessor({GltfComponent::kShort, "VEC3", false, true, true}, shorts);
  const int c = file.AddAccessor(
      {GltfComponent::kUnsignedShort, "SCALAR", false, false, false, true}, indices);
  const int d = file.AddAccessor({GltfComponent::kUnsignedInt, "SCALAR"}, many);
  const int e = file.AddAccessor({GltfComponent::kFloat, "VEC4"}, floats);
  const ReadGlb glb(file.Finish());
  EXPECT_EQ(glb.Numbers(a), bytes);
  EXPECT_EQ(glb.Numbers(b), shorts);
  EXPECT_EQ(glb.Numbers(c), indices);
  EXPECT_EQ(glb.Numbers(d), many);
  for (size_t i = 0; i < floats.size(); ++i) {
    EXPECT_EQ(glb.Numbers(e)[i], static_cast<double>(static_cast<float>(floats[i])));
  }
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.bytes.size());
  for (const Json& view : glb.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<size_t>() % 4, 0u);
    EXPECT_EQ(view.value("byteStride", size_t{4}) % 4, 0u);
  }
}

const Eigen::Vector3f kGrey(0.5f, 0.5f, 0.5f);

TEST(GltfMesh, VerticesOfASphereStayOnIt) {
  const double radius = 0.03;
  TriMesh sphere = MakeSphere(radius, 32);
  const Eigen::Vector3d centre(0.2, -0.1, 0.05);
  for (Eigen::Vector3d& vertex : sphere.vertices) vertex += centre;
  GlbFile file;
  const Json node = AddGltfMesh(sphere, kGrey, 1.0, file);
  const ReadGlb glb(file.Finish());
  EXPECT_EQ(glb.CountTriangles(), static_cast<size_t>(sphere.num_triangles()));
  const std::vector<double> positions = glb.Numbers(0), normals = glb.Numbers(1),
                            indices = glb.Numbers(2);
  ASSERT_EQ(positions.size(), normals.size());
  const Eigen::Vector3d offset = VectorFrom(node["translation"]);
  const double unit = node["scale"][0].get<double>();
  EXPECT_LE(unit, 2.0 * radius / 65533.0);
  for (size_t i = 0; i < positions.size(); i += 3) {
    const Eigen::Vector3d p =
        offset + unit * Eigen::Vector3d(positions[i], positions[i + 1], positions[i + 2]);
    const Eigen::Vector3d normal =
        Eigen::Vector3d(normals[i], normals[i + 1], normals[i + 2]) / 127.0;
    EXPECT_NEAR((p - centre).norm(), radius, unit);
    EXPECT_NEAR(normal.norm(), 1.0, 0.01);
    EXPECT_GT(normal.dot((p - centre).normalized()), 0.99);
  }
  double volume = 0.0;  // of the triangles as they are wound
  for (size_t t = 0; t < indices.size(); t += 3) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<size_t>(3.0 * indices[t + static_cast<size_t>(i)]);
      corners.col(i) = unit * Eigen::Vector3d(positions[at], positions[at + 1], positions[at + 2]);
    }
    volume += corners.determinant() / 6.0;
  }
  EXPECT_NEAR(volume / (4.0 / 3.0 * 3.14159265 * std::pow(radius, 3)), 1.0, 0.05);
}

TEST(GltfMesh, OfNothingIsNothing) {
  GlbFile file;
  EXPECT_TRUE(AddGltfMesh({}, kGrey, 1.0, file).is_null());
  TriMesh sliver;
  sliver.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 1e-12, 0.0}};
  sliver.triangles = {{0, 1, 2}};
  EXPECT_TRUE(AddGltfMesh(sliver, kGrey, 1.0, file).is_null());
  EXPECT_FALSE(file.root.contains("meshes"));
}

}  // namespace

}  // namespace graspbench
