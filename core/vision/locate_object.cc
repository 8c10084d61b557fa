#include "core/vision/locate_object.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSmallestArea = 60.0;  // less may be noise [pixel^2]
constexpr double kSmallShare = 0.05;    // of the largest region: a second thing, no speck
constexpr double kEdge = 1.5;           // nearer to the picture's edge is cut [pixel]
constexpr double kTolerance = 0.3;      // of an outline: a worse fit is clearly worse [pixel]
constexpr double kWorstFit = 0.003;     // [m]

// Of a suggestion.
constexpr double kLargeWidth = 0.047;   // [m]
constexpr double kRoundish = 1.85;      // length over width, less
constexpr double kSolid = 0.8;          // a propeller's blades fill less of their hull
constexpr double kThinWidth = 0.022;    // [m]
constexpr double kLongestForTwo = 0.2;  // [m]
constexpr double kSmallLength = 0.035;  // [m]

bool IsCut(const SeenRegion& region, const Lens& lens) {
  for (const Vector2d& p : region.contour) {
    if (p.x() < kEdge || p.y() < kEdge || p.x() > lens.width - kEdge ||
        p.y() > lens.height - kEdge) {
      return true;
    }
  }
  return false;
}

/** Why the regions are not one whole object; empty: they are. */
std::string FindFault(const std::vector<SeenRegion>& regions, const Lens& lens) {
  if (regions.empty() || regions[0].area < kSmallestArea) {
    return "no difference from the empty table is visible";
  }
  const double second = regions.size() > 1 ? regions[1].area : 0.0;
  if (second >= std::max(kSmallestArea, kSmallShare * regions[0].area)) {
    return "more than one thing is seen on the table";
  }
  if (IsCut(regions[0], lens)) return "what is seen reaches over the picture's edge";
  return "";
}

}  // namespace

Sighting LocateObject(const Image& picture, const Image& empty_table, const Lens& lens,
                      const Pose& X_WK, const OutlineModel& object, const PlanarPose& supposed) {
  const PictureTools& tools = LoadPictureTools();
  const std::vector<SeenRegion> regions =
      tools.find_regions(picture, empty_table, DifferenceRule());
  Sighting sighting;
  sighting.reason = FindFault(regions, lens);
  if (!sighting.reason.empty()) return sighting;

  const Vector3d p_WEye = X_WK.translation();
  std::vector<Vector2d> outline;
  for (const Vector2d& pixel : regions[0].contour) {
    const Vector3d ray_W = X_WK.linear() * CalcRay(lens, pixel);
    outline.push_back((p_WEye + (object.middle() - p_WEye.z()) / ray_W.z() * ray_W).head<2>());
  }
  const Rectangle rectangle = tools.find_smallest_rectangle(outline);
  PlanarPose start = supposed;
  start.x = rectangle.centre.x();
  start.y = rectangle.centre.y();
  const double pixel_size = (p_WEye.z() - object.middle()) / lens.focal_x;
  const OutlineFit fit =
      FitOutline(MakeSilhouette(outline), object, p_WEye, start, kTolerance * pixel_size);
  if (!(fit.residual + std::abs(fit.thickness) <= kWorstFit)) {
    sighting.reason = fmt::format(
        "what is seen, {:.0f} mm long and {:.0f} wide, has not the outline of the object",
        MmFromM(rectangle.length), MmFromM(rectangle.width));
    return sighting;
  }
  sighting.is_found = true;
  sighting.pose = fit.pose;
  sighting.direction = fit.direction;
  sighting.length = rectangle.length;
  sighting.width = rectangle.width;
  sighting.rectangle = rectangle;
  sighting.fill = CalcArea(outline) / CalcArea(FindHull(outline));
  sighting.outline = std::move(outline);
  return sighting;
}

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
