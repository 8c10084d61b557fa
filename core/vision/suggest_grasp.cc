#include "core/vision/suggest_grasp.h"

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr double kLargeWidth = 0.047;   // [m]
constexpr double kRoundish = 1.85;      // length over width, less
constexpr double kSolid = 0.8;          // a propeller's blades fill less of their hull
constexpr double kThinWidth = 0.022;    // [m]
constexpr double kLongestForTwo = 0.2;  // [m]
constexpr double kSmallLength = 0.035;  // [m]

}  // namespace

GraspType SuggestGraspType(const Sighting& seen) {
  GRASPBENCH_DEMAND(seen.is_found, "nothing was seen");
  if (seen.width >= kLargeWidth && seen.length < kRoundish * seen.width && seen.fill >= kSolid) {
    return GraspType::kPower;
  }
  const bool is_thin = seen.width < kThinWidth && seen.length < kLongestForTwo;
  if (is_thin || seen.length < kSmallLength) return GraspType::kTwoFingerPrecision;
  return GraspType::kAllFingerPrecision;
}

}  // namespace graspbench
