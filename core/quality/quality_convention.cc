#include "core/quality/quality_convention.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"

namespace graspbench {
namespace {

double CalcRadius(const ObjectExtent& object) { return object.radius; }

double CalcHalfDiagonal(const ObjectExtent& object) { return 0.5 * object.size.norm(); }

double CalcMedianHalfSide(const ObjectExtent& object) {
  std::array<double, 3> corner = {0.5 * object.size.x(), 0.5 * object.size.y(),
                                  0.5 * object.size.z()};
  std::sort(corner.begin(), corner.end());
  return corner[1];
}

}  // namespace

const std::vector<QualityConvention>& ListQualityConventions() {
  static const auto* const kConventions = new std::vector<QualityConvention>{
      {"ferrari-canny", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, true, 1.0, 8, 0.0,
       "as given; meant: largest distance of the surface from the centre of mass", CalcRadius},
      {"graspit", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, false, 1.0, 8, -1.0,
       "as given; meant: largest distance of the surface from the centre of mass", CalcRadius},
      {"simox", UnitForce::kTotal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromHullCentre, false, 1.0, 8, std::nullopt,
       "as given; meant: half the bounding length", CalcHalfDiagonal},
      {"dexgraspbench", UnitForce::kNormal, TorqueScaleRule::kMeanContactDistance,
       ReferenceRule::kContactCentroid, EpsilonRule::kTwoMinus, true, 0.5, 8, 2.0,
       "mean distance of the contacts from their centroid", CalcRadius},
      {"dex-net", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, false, 1.0, 8, 0.0,
       "as given; meant: median of the bounding box's upper corner", CalcMedianHalfSide},
      {"frogger", UnitForce::kTotal, TorqueScaleRule::kOneMetre, ReferenceRule::kFrameOrigin,
       EpsilonRule::kFromOrigin, false, 1.0, 4, -1.0, "not scaled", CalcRadius},
  };
  return *kConventions;
}

const QualityConvention& FindQualityConvention(const std::string& id) {
  const auto& all = ListQualityConventions();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const QualityConvention& row) { return row.id == id; });
  if (found != all.end()) return *found;
  std::vector<std::string> known;
  for (const QualityConvention& row : all) known.push_back(row.id);
  throw Error(ErrorKind::kNotFound,
              "no quality convention \"" + id + "\"" + SuggestNames(id, known));
}

}  // namespace graspbench
