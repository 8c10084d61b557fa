#include "core/hand/tactile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kFarFromSurface = 0.005;  // of an element; a smaller distance is a rounding error
                                           // [m]
constexpr double kMostArea = 1.1;          // of all cells, as a share of the sensed surface

/** Reads a direction and normalises it, so that a file may round it; an optional one may be 0. */
void ReadDirection(const std::string& key, Needed needed, YamlMap& map, Vector3d& direction) {
  map.Read(key, direction, needed);
  if (direction.norm() > 1e-6) {
    direction.normalize();
  } else if (needed == Needed::kYes && map.Has(key)) {
    map.Fail(key, "is no direction; one axis must differ from 0");
  }
}

std::vector<YAML::Node> ReadList(const std::string& key, YamlMap& map) {
  const YAML::Node node = map.Child(key);
  if (node.IsSequence() && node.size() > 0) return {node.begin(), node.end()};
  if (map.Has(key)) map.Fail(key, "expected a list with at least one entry");
  return {};
}

bool HasContact(const Hand& hand, int link) {
  return std::any_of(hand.capsules.begin(), hand.capsules.end(),
                     [&](const LinkCapsule& capsule) { return capsule.link == link; });
}

/** Reads an element; reports positions off the surface, as in millimetres or in another frame. */
TactileElement ReadElement(const Hand& hand, int link, YamlMap& map) {
  TactileElement element;
  element.link = link;
  map.Read("position_m", element.p_LE);
  ReadDirection("normal", Needed::kYes, map, element.normal_L);
  map.Read("area_m2", element.area);
  if (HasContact(hand, link)) {
    const double distance = (element.p_LE - ProjectOntoSurface(hand, link, element.p_LE)).norm();
    if (distance > kFarFromSurface) {
      map.Fail("position_m", "lies " + FormatFixed(MmFromM(distance), 1) +
                                 " mm from the contact surface of its link; expected metres, in "
                                 "the link's frame");
    }
  }
  map.FinishKnownKeys();
  return element;
}

/** Checks normals and areas, once the points have their elements. */
void CheckElements(const TactileSkin& skin, const SensedSurface& surface, YamlMap& map) {
  for (const TactileElement& element : skin.elements) {
    if (element.link != surface.part.link || surface.points.empty()) continue;
    const auto nearest = std::min_element(surface.points.begin(), surface.points.end(),
                                          [&](const SurfacePoint& a, const SurfacePoint& b) {
                                            return (a.p_L - element.p_LE).squaredNorm() <
                                                   (b.p_L - element.p_LE).squaredNorm();
                                          });
    if (nearest->normal_L.dot(element.normal_L) > 0.0) continue;
    map.Fail("elements", "a normal points into the hand, at position_m [" +
                             FormatFixed(element.p_LE.x(), 5) + ", " +
                             FormatFixed(element.p_LE.y(), 5) + ", " +
                             FormatFixed(element.p_LE.z(), 5) + "]; expected out of it");
  }
  double cells = 0.0, sensed = 0.0;
  for (const TactileElement& element : skin.elements) {
    if (element.link == surface.part.link) cells += element.area;
  }
  for (const SurfacePoint& point : surface.points) sensed += point.area;
  if (sensed > 0.0 && cells > kMostArea * sensed) {
    map.Fail("elements", "their areas sum to " + FormatFixed(1e4 * cells, 1) +
                             " cm2 on a surface of " + FormatFixed(1e4 * sensed, 1) +
                             " cm2; expected square metres");
  }
}

}  // namespace

const FileKeys& ListTactileKeys() {
  static const FileKeys keys = {
      {"response", kRequired, "of each element to its force: exponential or linear"},
      {"surfaces", kRequired, KeyType::kList,
       "list: the sensed part of a link's contact surface each"},
      {"surfaces.link", kRequired, "link of hand.urdf; once"},
      {"surfaces.palmar", "[0, 0, 0]",
       "only the side whose normal has a part along it; 0: all round"},
      {"surfaces.along", "[0, 0, 0]", "and only what lies in this direction beyond from_m; 0: all"},
      {"surfaces.from_m", "0", "from the link's origin", -1, 1},
      {"surfaces.elements", kRequired, KeyType::kList,
       "list; each has the part of the surface nearest to it"},
      {"surfaces.elements.position_m", kRequired, "on the surface, in the link's frame"},
      {"surfaces.elements.normal", kRequired, "direction out of the hand, in the link's frame"},
      {"surfaces.elements.area_m2", kRequired, "of its cell", kAboveZero},
  };
  return keys;
}

TactileSkin ParseTactile(const std::string& text, const std::string& file, const Hand& hand,
                         Diagnostics& problems) {
  TactileSkin skin;
  skin.content_hash = CalcHashHex(text);
  YamlMap root(ParseYaml(text, file, problems), file, "tactile.yaml", problems, &ListTactileKeys());
  std::string response;
  root.Read("response", response);
  if (const TactileResponseRow* row = FindRow(kTactileResponses, response)) {
    skin.response = row->value;
  } else if (!response.empty()) {
    root.Fail("response", "no response \"" + response + "\"" +
                              SuggestNames(response, ListNames(kTactileResponses)));
  }
  for (const YAML::Node& item : ReadList("surfaces", root)) {
    YamlMap map(item, file, "surface", problems, &ListTactileKeys(), "surfaces.");
    SensedSurface surface;
    std::string link;
    map.Read("link", link);
    ReadDirection("palmar", Needed::kNo, map, surface.part.palmar);
    ReadDirection("along", Needed::kNo, map, surface.part.along);
    map.Read("from_m", surface.part.from, Needed::kNo);
    surface.part.link = hand.FindLink(link);
    if (!link.empty() && surface.part.link < 0) {
      map.Fail("link", "the hand has no link \"" + link + "\"");
    } else if (skin.FindSurface(surface.part.link)) {
      map.Fail("link", "\"" + link + "\" has a surface already; give all its elements there");
    }
    for (const YAML::Node& entry : ReadList("elements", map)) {
      YamlMap element_map(entry, file, "element of " + link, problems, &ListTactileKeys(),
                          "surfaces.elements.");
      skin.elements.push_back(ReadElement(hand, surface.part.link, element_map));
    }
    map.FinishKnownKeys();
    surface.points = SampleSurface(hand, surface.part);
    if (surface.points.empty() && surface.part.link >= 0) {
      map.Fail("link", "\"" + link + "\" has no contact surface there");
    }
    AssignElements(skin.elements, surface);
    CheckElements(skin, surface, map);
    skin.surfaces.push_back(std::move(surface));
  }
  root.FinishKnownKeys();
  return skin;
}

namespace {

constexpr double kPointSpacing = 0.0007;  // [m]

int CountSteps(double length) {
  return std::max(1, static_cast<int>(std::ceil(length / kPointSpacing)));
}

/** Samples one capsule: rings along its axis and on both of its caps. */
std::vector<SurfacePoint> SampleCapsule(const LinkCapsule& capsule) {
  const Vector3d span = capsule.p_LB - capsule.p_LA;
  const double r = capsule.radius, length = span.norm();
  const Eigen::Matrix3d frame =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(),
                                         length > 0.0 ? Vector3d(span / length) : Vector3d::UnitZ())
          .toRotationMatrix();
  std::vector<SurfacePoint> points;
  const auto add_ring = [&](double height, double elevation, double ring_area) {
    const int count = CountSteps(2.0 * kPi * r * std::cos(elevation));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * kPi * (i + 0.5) / count;
      SurfacePoint point;
      point.normal_L = frame * Vector3d(std::cos(elevation) * std::cos(turn),
                                        std::cos(elevation) * std::sin(turn), std::sin(elevation));
      point.p_L = capsule.p_LA + frame * Vector3d(0.0, 0.0, height) + r * point.normal_L;
      point.area = ring_area / count;
      points.push_back(point);
    }
  };
  const int num_rings = CountSteps(length), num_caps = CountSteps(0.5 * kPi * r);
  for (int i = 0; length > 0.0 && i < num_rings; ++i) {
    add_ring(length * (i + 0.5) / num_rings, 0.0, 2.0 * kPi * r * length / num_rings);
  }
  for (int i = 0; i < num_caps; ++i) {
    const double low = 0.5 * kPi * i / num_caps, high = 0.5 * kPi * (i + 1) / num_caps;
    const double area = 2.0 * kPi * r * r * (std::sin(high) - std::sin(low));
    add_ring(length, 0.5 * (low + high), area);
    add_ring(0.0, -0.5 * (low + high), area);
  }
  return points;
}

}  // namespace

const SensedSurface* TactileSkin::FindSurface(int link) const {
  for (const SensedSurface& surface : surfaces) {
    if (surface.part.link == link) return &surface;
  }
  return nullptr;
}

std::vector<SurfacePoint> SampleSurface(const Hand& hand, const SensedPart& part) {
  std::vector<SurfacePoint> points;
  for (const LinkCapsule& capsule : hand.capsules) {
    if (capsule.link != part.link) continue;
    for (const SurfacePoint& point : SampleCapsule(capsule)) {
      const bool is_inside =
          std::any_of(hand.capsules.begin(), hand.capsules.end(), [&](const LinkCapsule& other) {
            return &other != &capsule && other.link == part.link &&
                   CalcDistanceToCapsule(other, point.p_L) < -1e-9;
          });
      const bool faces = part.palmar.isZero() || point.normal_L.dot(part.palmar) > 1e-9;
      const bool lies_beyond = part.along.isZero() || point.p_L.dot(part.along) >= part.from;
      if (!is_inside && faces && lies_beyond) points.push_back(point);
    }
  }
  return points;
}

void AssignElements(const std::vector<TactileElement>& elements, SensedSurface& surface) {
  for (SurfacePoint& point : surface.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < elements.size(); ++i) {
      const double distance = (elements[i].p_LE - point.p_L).squaredNorm();
      if (elements[i].link != surface.part.link || distance >= nearest) continue;
      nearest = distance;
      point.element = static_cast<int>(i);
    }
  }
}

Vector3d ProjectOntoSurface(const Hand& hand, int link, const Vector3d& p_L) {
  const LinkCapsule* nearest = nullptr;
  for (const LinkCapsule& capsule : hand.capsules) {
    if (capsule.link != link) continue;
    if (!nearest || CalcDistanceToCapsule(capsule, p_L) < CalcDistanceToCapsule(*nearest, p_L))
      nearest = &capsule;
  }
  GRASPBENCH_DEMAND(nearest != nullptr, "link " + std::to_string(link) + " has no contact");
  const Vector3d on_axis = FindNearestOnAxis(*nearest, p_L);
  const Vector3d away = p_L - on_axis;
  if (away.isZero(1e-9)) return p_L;
  return on_axis + nearest->radius * away.normalized();
}

}  // namespace graspbench
