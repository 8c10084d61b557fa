#include <png.h>

#include <vector>

#include "core/base/error.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

void AppendTo(png_structp png, png_bytep bytes, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(bytes), size);
}

// libpng must not return from here; nothing but running out of memory leads to it.
void StopOnError(png_structp, png_const_charp message) {
  throw Error(ErrorKind::kEnvironment, std::string("cannot write a PNG picture: ") + message);
}

}  // namespace

std::string EncodePng(const Image& image) {
  const size_t row_size = 3 * static_cast<size_t>(image.width);
  GRASPBENCH_DEMAND(image.width > 0 && image.height > 0 &&
                        image.rgb.size() == row_size * static_cast<size_t>(image.height),
                    std::to_string(image.width) + " x " + std::to_string(image.height) + " with " +
                        std::to_string(image.rgb.size()) + " bytes");
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, StopOnError, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, AppendTo, nullptr);
  png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, 9);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.rgb.data() + y * row_size);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace graspbench
