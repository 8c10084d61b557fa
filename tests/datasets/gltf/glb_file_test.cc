#include "datasets/gltf/glb_file.h"

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

TEST(GlbFile, SaysTheRangeThatAReaderFinds) {
  GlbFile file;
  file.AddAccessor({GltfComponent::kFloat, "SCALAR", false, true}, {0.3, 0.1, 0.7});
  const ReadGlb glb(file.Finish());
  EXPECT_EQ(glb.json["accessors"][0]["min"][0], static_cast<double>(0.1f));
  EXPECT_EQ(glb.json["accessors"][0]["max"][0], static_cast<double>(0.7f));
}

TEST(GlbFile, KeepsWhatWasPutIntoItAndNeedsNoBuffer) {
  GlbFile file;
  file.root["extras"] = {{"text", "\"}]\xff</script>"}};
  const ReadGlb glb(file.Finish());
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["extras"]["text"], "\"}]\xef\xbf\xbd</script>");
  EXPECT_FALSE(glb.json.contains("buffers"));
}

}  // namespace
}  // namespace graspbench
