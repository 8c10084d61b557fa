#pragma once
/** @file
A GLB file taken apart as the specification says, independent of the writer. */

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/text/json.h"

namespace graspbench {

struct ReadGlb {
  Json json;
  std::string bytes;  ///< of the buffer

  explicit ReadGlb(const std::string& glb) {
    EXPECT_EQ(glb.substr(0, 4), "glTF");
    EXPECT_EQ(Integer(glb, 4), 2u);
    EXPECT_EQ(Integer(glb, 8), glb.size());
    for (size_t at = 12; at + 8 <= glb.size();) {
      const uint32_t length = Integer(glb, at);
      EXPECT_EQ(length % 4, 0u);
      const std::string type = glb.substr(at + 4, 4);
      const std::string content = glb.substr(at + 8, length);
      EXPECT_EQ(content.size(), length);
      if (type == "JSON") json = Json::parse(content);
      if (type != "JSON") bytes = content;
      at += 8 + length;
    }
  }

  /** The numbers of an accessor, element after element; integers as they are stored. */
  std::vector<double> Numbers(int index) const {
    const Json& accessor = json.at("accessors").at(static_cast<size_t>(index));
    const Json& view = json.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
    const std::string& type = accessor.at("type").str();
    const size_t num_parts = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    const int component = accessor.at("componentType").get<int>();
    const size_t size = component == 5120 ? 1 : component == 5122 || component == 5123 ? 2 : 4;
    const size_t stride = view.value("byteStride", num_parts * size);
    std::vector<double> numbers;
    for (size_t element = 0; element < accessor.at("count").get<size_t>(); ++element) {
      for (size_t part = 0; part < num_parts; ++part) {
        const char* from =
            bytes.data() + view.at("byteOffset").get<size_t>() + element * stride + part * size;
        EXPECT_LE(from + size, bytes.data() + bytes.size());
        numbers.push_back(component == 5120   ? As<int8_t>(from)
                          : component == 5122 ? As<int16_t>(from)
                          : component == 5123 ? As<uint16_t>(from)
                          : component == 5125 ? As<uint32_t>(from)
                                              : static_cast<double>(As<float>(from)));
      }
    }
    return numbers;
  }

  size_t CountTriangles() const {
    size_t count = 0;
    for (const Json& mesh : json.value("meshes", Json::array())) {
      const auto indices = mesh.at("primitives").at(0).at("indices").get<size_t>();
      count += json.at("accessors").at(indices).at("count").get<size_t>() / 3;
    }
    return count;
  }

 private:
  template <class T>
  static T As(const char* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
  }
  static uint32_t Integer(const std::string& text, size_t at) {
    return As<uint32_t>(text.data() + at);
  }
};

}  // namespace graspbench
