#include "datasets/gltf/glb_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr size_t kAlignment = 4;  // of chunks and of vertices [bytes]
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

size_t CountComponents(std::string_view type) {
  return type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
}

void AppendInteger(uint32_t value, size_t num_bytes, std::string& bytes) {
  for (size_t i = 0; i < num_bytes; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

void AppendNumber(GltfComponent component, double value, std::string& bytes) {
  switch (component) {
    case GltfComponent::kByte:
      return AppendInteger(static_cast<uint32_t>(static_cast<int32_t>(value)), 1, bytes);
    case GltfComponent::kShort:
      return AppendInteger(static_cast<uint32_t>(static_cast<int32_t>(value)), 2, bytes);
    case GltfComponent::kUnsignedShort:
      return AppendInteger(static_cast<uint32_t>(value), 2, bytes);
    case GltfComponent::kUnsignedInt:
      return AppendInteger(static_cast<uint32_t>(value), 4, bytes);
    case GltfComponent::kFloat:
      const float single = static_cast<float>(value);
      uint32_t bits = 0;
      std::memcpy(&bits, &single, sizeof(bits));
      return AppendInteger(bits, 4, bytes);
  }
}

/** What a reader of the accessor finds. */
double CalcStored(GltfComponent component, double value) {
  return component == GltfComponent::kFloat ? static_cast<double>(static_cast<float>(value))
                                            : value;
}

void Align(char filling, std::string& bytes) {
  bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, filling);
}

std::string MakeChunk(const char* type, const std::string& content) {
  std::string chunk;
  AppendInteger(static_cast<uint32_t>(content.size()), 4, chunk);
  return chunk.append(type, 4) + content;
}

}  // namespace

int GlbFile::AddAccessor(const GltfNumbers& numbers, const std::vector<double>& values) {
  const size_t num_components = CountComponents(numbers.type);
  GRASPBENCH_DEMAND(!values.empty() && values.size() % num_components == 0,
                    std::to_string(values.size()));
  const size_t start = bytes_.size();
  for (size_t i = 0; i < values.size(); ++i) {
    GRASPBENCH_DEMAND(std::isfinite(values[i]), numbers.type);
    AppendNumber(numbers.component, values[i], bytes_);
    const bool ends_element = (i + 1) % num_components == 0;
    if (numbers.is_vertex_data && ends_element) Align('\0', bytes_);
  }
  const size_t num_elements = values.size() / num_components;
  Json view = {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}};
  if (numbers.is_vertex_data) {
    view["byteStride"] = (bytes_.size() - start) / num_elements;
    view["target"] = kVertexBuffer;
  } else if (numbers.is_index_data) {
    view["target"] = kIndexBuffer;
  }
  Align('\0', bytes_);

  Json accessor = {{"bufferView", views_.size()},
                   {"componentType", static_cast<int>(numbers.component)},
                   {"count", num_elements},
                   {"type", numbers.type}};
  if (numbers.is_normalised) accessor["normalized"] = true;
  for (size_t c = 0; numbers.has_range && c < num_components; ++c) {
    double low = values[c], high = values[c];
    for (size_t i = c; i < values.size(); i += num_components) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    accessor["min"].push_back(CalcStored(numbers.component, low));
    accessor["max"].push_back(CalcStored(numbers.component, high));
  }
  views_.push_back(std::move(view));
  accessors_.push_back(std::move(accessor));
  return static_cast<int>(accessors_.size()) - 1;
}

std::string GlbFile::Finish() {
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "graspbench"}}}};
  json.update(root);
  if (!bytes_.empty()) {
    json["buffers"] = Json::array({Json{{"byteLength", bytes_.size()}}});
    json["bufferViews"] = views_;
    json["accessors"] = accessors_;
  }
  std::string text = FormatJson(json);
  Align(' ', text);
  std::string chunks = MakeChunk("JSON", text);
  if (!bytes_.empty()) chunks += MakeChunk("BIN\0", bytes_);
  std::string glb = "glTF";
  AppendInteger(2, 4, glb);
  AppendInteger(static_cast<uint32_t>(4 + 4 + 4 + chunks.size()), 4, glb);
  return glb + chunks;
}

}  // namespace graspbench
