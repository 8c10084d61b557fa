#include <png.h>
#include <webp/encode.h>

#include "core/base/error.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

void CheckPixels(const Image& image) {
  GRASPBENCH_DEMAND(image.width > 0 && image.height > 0 &&
                        image.rgb.size() == 3 * static_cast<size_t>(image.width) * image.height,
                    std::to_string(image.width) + " x " + std::to_string(image.height) + " with " +
                        std::to_string(image.rgb.size()) + " bytes");
}

}  // namespace

std::string EncodePng(const Image& image) {
  CheckPixels(image);
  png_image writer = {};
  writer.version = PNG_IMAGE_VERSION;
  writer.width = image.width;
  writer.height = image.height;
  writer.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(writer), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&writer, bytes.data(), &size, /*convert_to_8bit=*/0,
                                 image.rgb.data(), /*row_stride=*/0, /*colormap=*/nullptr)) {
    throw Error(ErrorKind::kEnvironment,
                std::string("cannot write a PNG picture: ") + writer.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string EncodeWebp(const Image& image) {
  CheckPixels(image);
  constexpr float kQuality = 75.0f;  // of 100
  uint8_t* encoded = nullptr;
  const size_t size = WebPEncodeRGB(image.rgb.data(), image.width, image.height, 3 * image.width,
                                    kQuality, &encoded);
  const std::string bytes(reinterpret_cast<const char*>(encoded), size);
  WebPFree(encoded);
  if (size == 0) {
    throw Error(ErrorKind::kUnsupported,
                "cannot write a WebP picture of " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " pixels; expected 1 to " +
                    std::to_string(WEBP_MAX_DIMENSION) + " on each side");
  }
  return bytes;
}

}  // namespace graspbench
