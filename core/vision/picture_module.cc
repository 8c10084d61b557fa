// graspbench-vision.so: the only file that knows OpenCV. Opened by picture_tools.cc.

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/vision/picture_tools.h"

namespace graspbench {
namespace {

cv::Mat Wrap(const Image& image) {
  return cv::Mat(image.height, image.width, CV_8UC3, const_cast<uint8_t*>(image.rgb.data()));
}

// What a grey level becomes under another exposure: sRGB decoded, scaled, encoded.
std::array<float, 256> MakeExposureTable(double exposure) {
  std::array<float, 256> table{};
  for (int level = 0; level < 256; ++level) {
    const double srgb = level / 255.0;
    const double light = srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
    const double scaled = std::min(exposure * light, 1.0);
    table[level] = static_cast<float>(
        255.0 * (scaled <= 0.0031308 ? 12.92 * scaled : 1.055 * std::pow(scaled, 1 / 2.4) - 0.055));
  }
  return table;
}

Image ApplyFaults(const Image& picture, const PictureFaults& faults) {
  cv::setNumThreads(1);  // trials run in parallel, and each picture has the same bytes
  cv::Mat seen = Wrap(picture);
  if (!faults.from_x.empty()) {
    // OpenCV counts from the first pixel's middle.
    const cv::Size size(faults.width, faults.height);
    const cv::Mat x(size, CV_32FC1, const_cast<float*>(faults.from_x.data()));
    const cv::Mat y(size, CV_32FC1, const_cast<float*>(faults.from_y.data()));
    cv::Mat warped;
    cv::remap(seen, warped, x - 0.5, y - 0.5, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    seen = warped;
  }
  if (faults.blur > 0.0) {
    cv::Mat blurred;
    cv::GaussianBlur(seen, blurred, cv::Size(), faults.blur, faults.blur, cv::BORDER_REPLICATE);
    seen = blurred;
  }
  if (faults.exposure != 1.0) {
    const std::array<float, 256> table = MakeExposureTable(faults.exposure);
    cv::Mat exposed;
    cv::LUT(seen, cv::Mat(1, 256, CV_32FC1, const_cast<float*>(table.data())), exposed);
    exposed.convertTo(seen, CV_8U);
  }
  if (faults.noise > 0.0) {
    cv::Mat noise(seen.size(), CV_16SC3), noisy;
    cv::RNG random(faults.noise_seed);
    random.fill(noise, cv::RNG::NORMAL, 0.0, faults.noise);
    cv::add(seen, noise, noisy, cv::noArray(), CV_8UC3);
    seen = noisy;
  }
  Image result;
  result.width = seen.cols;
  result.height = seen.rows;
  result.rgb.resize(3 * static_cast<size_t>(seen.rows) * static_cast<size_t>(seen.cols));
  seen.copyTo(Wrap(result));
  return result;
}

// How far a pixel is from every brightness that the reference could have in a shadow (Horprasert,
// Harwood, Davis 1999, without their scaling by each pixel's own noise).
cv::Mat FindDifferent(const Image& picture, const Image& reference, const DifferenceRule& rule) {
  cv::Mat mask(picture.height, picture.width, CV_8UC1);
  const float low = static_cast<float>(rule.darkest_shadow);
  const float high = static_cast<float>(rule.brightest);
  const float limit = static_cast<float>(rule.threshold * rule.threshold);
  const size_t num_pixels = picture.rgb.size() / 3;
  for (size_t i = 0; i < num_pixels; ++i) {
    const uint8_t *p = &picture.rgb[3 * i], *r = &reference.rgb[3 * i];
    const float p0 = p[0], p1 = p[1], p2 = p[2], r0 = r[0], r1 = r[1], r2 = r[2];
    const float share =
        std::clamp((p0 * r0 + p1 * r1 + p2 * r2) / (r0 * r0 + r1 * r1 + r2 * r2 + 1.0f), low, high);
    const float d0 = p0 - share * r0, d1 = p1 - share * r1, d2 = p2 - share * r2;
    mask.data[i] = d0 * d0 + d1 * d1 + d2 * d2 > limit ? 255 : 0;
  }
  return mask;
}

std::vector<SeenRegion> FindRegions(const Image& picture, const Image& reference,
                                    const DifferenceRule& rule) {
  cv::setNumThreads(1);
  const cv::Mat mask = FindDifferent(picture, reference, rule);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<SeenRegion> regions;
  for (const std::vector<cv::Point>& contour : contours) {
    SeenRegion region;
    // The contour runs through the middles of pixels, half a pixel inside the region.
    region.area = cv::contourArea(contour) + 0.5 * static_cast<double>(contour.size());
    for (const cv::Point& point : contour) {
      region.contour.emplace_back(point.x + 0.5, point.y + 0.5);
    }
    regions.push_back(std::move(region));
  }
  std::stable_sort(regions.begin(), regions.end(),
                   [](const SeenRegion& a, const SeenRegion& b) { return a.area > b.area; });
  return regions;
}

std::vector<cv::Point2f> ToPoints(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point2f> result;
  for (const Eigen::Vector2d& p : points) {
    result.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  return result;
}

Rectangle FindSmallestRectangle(const std::vector<Eigen::Vector2d>& points) {
  const cv::RotatedRect found = cv::minAreaRect(ToPoints(points));
  Rectangle result;
  result.centre = Eigen::Vector2d(found.center.x, found.center.y);
  result.length = found.size.width;
  result.width = found.size.height;
  result.direction = found.angle * CV_PI / 180.0;
  if (result.length < result.width) {
    std::swap(result.length, result.width);
    result.direction += 0.5 * CV_PI;
  }
  return result;
}

}  // namespace
}  // namespace graspbench

extern "C" __attribute__((visibility("default")))
const graspbench::PictureTools graspbench_picture_tools = {
    graspbench::ApplyFaults, graspbench::FindRegions, graspbench::FindSmallestRectangle};
