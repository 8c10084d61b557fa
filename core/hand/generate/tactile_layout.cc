#include "core/hand/generate/tactile_layout.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kNumRounds = 200;
constexpr double kDensity = 7e4;  // density of elements on a fingertip [1/m^2]
constexpr int kFingertipElements = 34;

/** Rounds to the resolution of the file: 0.01 mm. */
Vector3d Round(const Vector3d& p) { return (p * 1e5).array().round() / 1e5; }

size_t FindNearest(const std::vector<SurfacePoint>& points, const Vector3d& p) {
  const auto nearest = std::min_element(
      points.begin(), points.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
        return (a.p_L - p).squaredNorm() < (b.p_L - p).squaredNorm();
      });
  return static_cast<size_t>(nearest - points.begin());
}

/** Chooses points, each as far as possible from those before. */
std::vector<TactileElement> Scatter(const SensedPart& part, const std::vector<SurfacePoint>& points,
                                    int count) {
  std::vector<TactileElement> elements;
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  size_t next = 0;
  for (int i = 0; i < count; ++i) {
    elements.push_back({part.link, points[next].p_L, points[next].normal_L, 0.0});
    for (size_t k = 0; k < points.size(); ++k) {
      distance[k] = std::min(distance[k], (points[k].p_L - points[next].p_L).norm());
    }
    next =
        static_cast<size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return elements;
}

double CalcTotalArea(const std::vector<SurfacePoint>& points) {
  double area = 0.0;
  for (const SurfacePoint& point : points) area += point.area;
  return area;
}

/** Extends the fingertip backwards by steps of 0.1 mm until its elements have the known density. */
SensedPart MakeFingertip(const Hand& hand, int link) {
  SensedPart part{link, -Vector3d::UnitY(), Vector3d::UnitZ(), 0.04};
  while (CalcTotalArea(SampleSurface(hand, part)) < kFingertipElements / kDensity) {
    part.from = std::round((part.from - 1e-4) * 1e4) / 1e4;
    GRASPBENCH_DEMAND(part.from > -0.04, "too small a fingertip");
  }
  return part;
}

std::string FormatVector(const Vector3d& v, int digits) {
  const auto number = [digits](double x) {
    return fmt::format("{:.{}f}", x == 0.0 ? 0.0 : x, digits);
  };
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

std::string FormatSurface(const Hand& hand, const SensedPart& part, int count) {
  std::string text = "  - link: " + hand.links[static_cast<size_t>(part.link)].name + "\n";
  if (!part.palmar.isZero()) text += "    palmar: " + FormatVector(part.palmar, 0) + "\n";
  if (!part.along.isZero()) {
    text += "    along: " + FormatVector(part.along, 0) +
            fmt::format("\n    from_m: {:.4f}\n", part.from);
  }
  text += "    elements:\n";
  for (const TactileElement& element : PlaceElements(part, SampleSurface(hand, part), count)) {
    text += "      - {position_m: " + FormatVector(element.p_LE, 5) +
            ", normal: " + FormatVector(element.normal_L, 3) +
            fmt::format(", area_m2: {:.2e}}}\n", element.area);
  }
  return text;
}

std::string FormatShadow(const Hand& hand) {
  std::string text =
      "# The tactile elements of the Shadow Hand: 34 a fingertip, some seven a square centimetre, "
      "and\n"
      "# two on the palmar side of each finger's middle and proximal phalanx, with an exponential\n"
      "# response (Roethling 2007, 3.1.2). Their places are proposals: cells of nearly equal "
      "area.\n"
      "# Made by generate_tactile; format: core/hand/tactile.h.\n"
      "response: exponential\nsurfaces:\n";
  for (const Digit& digit : hand.digits) {
    text += FormatSurface(hand, MakeFingertip(hand, digit.distal_link), kFingertipElements);
    if (digit.is_thumb) continue;
    const size_t num_links = digit.links.size();
    for (const size_t back : {size_t{2}, size_t{3}}) {  // middle, proximal
      SensedPart part;
      part.link = digit.links[num_links - back];
      part.palmar = -Vector3d::UnitY();
      text += FormatSurface(hand, part, 2);
    }
  }
  return text;
}

std::string FormatTum(const Hand& hand) {
  std::string text =
      "# A force sensor in each fingertip of the TUM Hand (Roethling 2007, 3.1.1); that it feels "
      "all\n"
      "# round, and its linear response, are proposals. Made by generate_tactile; format:\n"
      "# core/hand/tactile.h.\n"
      "response: linear\nsurfaces:\n";
  for (const Digit& digit : hand.digits) {
    SensedPart part;
    part.link = digit.distal_link;
    text += FormatSurface(hand, part, 1);
  }
  return text;
}

}  // namespace

std::vector<TactileElement> PlaceElements(const SensedPart& part,
                                          const std::vector<SurfacePoint>& points, int count) {
  GRASPBENCH_DEMAND(points.size() >= static_cast<size_t>(count), "too few points");
  std::vector<TactileElement> elements = Scatter(part, points, count);
  SensedSurface surface{part, points};
  for (int round = 0; round < kNumRounds; ++round) {
    AssignElements(elements, surface);
    std::vector<Vector3d> sums(elements.size(), Vector3d::Zero());
    for (TactileElement& element : elements) element.area = 0.0;
    for (const SurfacePoint& point : surface.points) {
      const auto i = static_cast<size_t>(point.element);
      sums[i] += point.area * point.p_L;
      elements[i].area += point.area;
    }
    if (round + 1 == kNumRounds) break;
    for (size_t i = 0; i < elements.size(); ++i) {
      const SurfacePoint& middle = points[FindNearest(points, sums[i] / elements[i].area)];
      elements[i].p_LE = Round(middle.p_L);
      elements[i].normal_L = middle.normal_L;
    }
  }
  return elements;
}

std::string MakeTactileYaml(const Hand& hand) {
  return hand.id.rfind("shadow", 0) == 0 ? FormatShadow(hand) : FormatTum(hand);
}

}  // namespace graspbench
