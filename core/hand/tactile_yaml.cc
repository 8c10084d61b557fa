#include "core/hand/tactile_yaml.h"

#include <algorithm>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kFarFromSurface = 0.005;  // of an element: a slip of the pen is less [m]
constexpr double kMostArea = 1.1;          // of all cells, share of the sensed surface

/** To length 1, so that a file need not have all digits; what may be missing may be 0. */
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

/** Whoever writes millimetres, or in another frame, is told. */
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

/** After the points have their elements. */
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

}  // namespace graspbench
