#include "core/base/random.h"

#include <cmath>

#include "core/base/hash.h"
#include "core/base/units.h"

namespace graspbench {

RandomStream::RandomStream(std::string_view id, std::string_view purpose)
    : state_(CalcHash64(purpose, CalcHash64(id))) {}

uint64_t RandomStream::NextBits() {
  state_ += 0x9e3779b97f4a7c15u;
  uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double RandomStream::NextUnit() { return static_cast<double>(NextBits() >> 11) * 0x1.0p-53; }

double RandomStream::NextNormal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - NextUnit()));
  return radius * std::cos(2.0 * kPi * NextUnit());
}

int RandomStream::NextIndex(int count) { return static_cast<int>(NextUnit() * count); }

}  // namespace graspbench
