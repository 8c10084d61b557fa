#include <png.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/render/scene.h"

namespace graspbench {
namespace {

constexpr float kQuality = 75.0f;  // of 100
constexpr int kEffort = 2;  // of 6: with 4, libwebp's own, 2.4 times the time for 6 % fewer bytes

int RoundToMs(double time) { return static_cast<int>(std::lround(MsFromS(time))); }

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
  bool is_written = WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, kQuality) != 0 &&
                    WebPPictureInit(&picture) != 0;
  if (is_written) {
    config.method = kEffort;
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

struct AnimatedWebp::Encoder {
  WebPAnimEncoder* encoder = nullptr;
  WebPConfig config;
  int width = 0, height = 0;

  ~Encoder() { WebPAnimEncoderDelete(encoder); }
  void Demand(bool is_done) const {
    if (is_done) return;
    throw Error(ErrorKind::kEnvironment,
                std::string("cannot write a WebP animation: ") + WebPAnimEncoderGetError(encoder));
  }
};

AnimatedWebp::AnimatedWebp(int width, int height) : encoder_(std::make_unique<Encoder>()) {
  WebPAnimEncoderOptions options;
  GRASPBENCH_DEMAND(WebPAnimEncoderOptionsInit(&options) && WebPConfigInit(&encoder_->config),
                    "libwebp of another version");
  encoder_->config.quality = kQuality;
  encoder_->config.method = kEffort;
  encoder_->width = width;
  encoder_->height = height;
  if (width >= 1 && height >= 1 && width <= WEBP_MAX_DIMENSION && height <= WEBP_MAX_DIMENSION) {
    encoder_->encoder = WebPAnimEncoderNew(width, height, &options);
  }
  if (!encoder_->encoder) {
    throw Error(ErrorKind::kUnsupported, "cannot write a WebP animation of " +
                                             std::to_string(width) + " x " +
                                             std::to_string(height) + " pixels");
  }
}

AnimatedWebp::~AnimatedWebp() = default;

void AnimatedWebp::Add(const Image& image, double time) {
  GRASPBENCH_DEMAND(image.width == encoder_->width && image.height == encoder_->height,
                    std::to_string(image.width) + " x " + std::to_string(image.height));
  WebPPicture picture;
  WebPPictureInit(&picture);
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  const bool is_done =
      WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) &&
      WebPAnimEncoderAdd(encoder_->encoder, &picture, RoundToMs(time), &encoder_->config);
  WebPPictureFree(&picture);
  encoder_->Demand(is_done);
}

std::string AnimatedWebp::Finish(double end) {
  encoder_->Demand(WebPAnimEncoderAdd(encoder_->encoder, nullptr, RoundToMs(end), nullptr));
  WebPData data;
  WebPDataInit(&data);
  encoder_->Demand(WebPAnimEncoderAssemble(encoder_->encoder, &data));
  const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  return bytes;
}

}  // namespace graspbench
