#include "core/trial/basin.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

/** The digits of `index` in the base, mirrored at the point: in [0, 1). */
double CalcHalton(int index, int base) {
  double value = 0.0, digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

}  // namespace

BasinSample MakeBasinSample(int index, double offset, double yaw) {
  BasinSample sample;
  if (index == 0) return sample;
  sample.offset_x = offset * (2.0 * CalcHalton(index, 2) - 1.0);
  sample.offset_y = offset * (2.0 * CalcHalton(index, 3) - 1.0);
  sample.yaw = yaw * (2.0 * CalcHalton(index, 5) - 1.0);
  return sample;
}

std::vector<BasinSample> MakeBasinSamples(int count) {
  std::vector<BasinSample> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(MakeBasinSample(i, kBasinOffset, kBasinYaw));
  }
  return samples;
}

double CalcBasinDistance(const BasinSample& sample) {
  return std::hypot(sample.offset_x / kBasinOffset, sample.offset_y / kBasinOffset,
                    sample.yaw / kBasinYaw);
}

double CalcBasinRadius(const std::vector<BasinSample>& samples) {
  double radius = 1.0;
  for (const BasinSample& sample : samples) {
    if (sample.outcome != Outcome::kSuccess) {
      radius = std::min(radius, CalcBasinDistance(sample));
    }
  }
  return radius;
}

}  // namespace graspbench
