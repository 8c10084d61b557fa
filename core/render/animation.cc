#include "core/render/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr float kQuality = 75.0f;  // of 100; a picture passes quickly
constexpr int kEffort = 2;         // of 6: more is little smaller and takes much longer

int RoundToMs(double time) { return static_cast<int>(std::lround(MsFromS(time))); }

}  // namespace

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
