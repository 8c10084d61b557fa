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
  writer.flags = PNG_IMAGE_FLAG_FAST;
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
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  bool is_written = WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, /*quality=*/75.0f) != 0 &&
                    WebPPictureInit(&picture) != 0;
  if (is_written) {
    config.method = 2;  // of 0 to 6: with 4, libwebp's own, 2.4 times the time for 6 % fewer bytes
    picture.width = image.width;
    picture.height = image.height;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    is_written = WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) != 0 &&
                 WebPEncode(&config, &picture) != 0;
    WebPPictureFree(&picture);
  }
  const std::string bytes(reinterpret_cast<const char*>(writer.mem), writer.size);
  WebPMemoryWriterClear(&writer);
  if (!is_written) {
    throw Error(ErrorKind::kUnsupported,
                "cannot write a WebP picture of " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " pixels; expected 1 to " +
                    std::to_string(WEBP_MAX_DIMENSION) + " on each side");
  }
  return bytes;
}

}  // namespace graspbench
