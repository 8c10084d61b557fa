#pragma once
/** @file
Random streams derived from ids.

A stream is named, never seeded from the clock. RandomStream("a1b2c3", "object pose") gives the same
numbers on every machine, for any order of trials and any number of threads. The generator is
SplitMix64 (Steele, Lea, Flood 2014), started at the hash of the names. The mapping to numbers is
our own, because the distributions of the standard library differ between implementations. */

#include <cstdint>
#include <string_view>

namespace graspbench {

class RandomStream {
 public:
  RandomStream(std::string_view id, std::string_view purpose);

  uint64_t NextBits();
  /** Uniform in [0, 1) with 53 random bits. */
  double NextUnit();
  double NextUniform(double low, double high) { return low + (high - low) * NextUnit(); }
  /** Standard normal by Box-Muller. Each number takes two uniform numbers, so that the stream's
  position is predictable. */
  double NextNormal();
  /** Uniform in {0, .., count - 1}, count >= 1. */
  int NextIndex(int count);

 private:
  uint64_t state_;
};

/** Range from which a number is drawn uniformly. */
struct DrawnRange {
  double low = 0.0, high = 0.0;
  double Draw(RandomStream& stream) const { return stream.NextUniform(low, high); }
};

}  // namespace graspbench
