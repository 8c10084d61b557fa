#pragma once
/** @file
Limits between which a number is drawn evenly. */

#include "core/base/random.h"

namespace graspbench {

struct DrawnRange {
  double low = 0.0, high = 0.0;
  double Draw(RandomStream& stream) const { return stream.NextUniform(low, high); }
};

}  // namespace graspbench
