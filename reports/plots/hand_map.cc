#include "reports/plots/hand_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/tactile.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kPixelsPerMetre = 2600.0;
constexpr double kNarrowest = 0.3;  // of a disc that faces sideways, share of its width

struct MapDisc {
  double x = 0.0, y = 0.0, radius = 0.0;  // [px]
  double width = 1.0;                     // share of the radius
  size_t element = 0;
};

std::vector<MapDisc> PlaceDiscs(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  Vector3d tips = Vector3d::Zero();
  for (const Digit& digit : hand.digits) tips += X_HL[digit.distal_link] * digit.p_LTip;
  const Vector3d normal = hand.palm_normal.normalized();
  Vector3d up = tips / static_cast<double>(hand.digits.size()) - hand.p_HCentre;
  up -= up.dot(normal) * normal;
  up.normalize();
  const Vector3d right = up.cross(normal);
  std::vector<MapDisc> discs;
  for (size_t i = 0; i < hand.skin->elements.size(); ++i) {
    const TactileElement& element = hand.skin->elements[i];
    const Vector3d p_H = X_HL[element.link] * element.p_LE;
    const double facing = (X_HL[element.link].linear() * element.normal_L).dot(normal);
    discs.push_back({kPixelsPerMetre * p_H.dot(right), -kPixelsPerMetre * p_H.dot(up),
                     kPixelsPerMetre * std::sqrt(element.area / kPi),
                     std::clamp(facing, kNarrowest, 1.0), i});
  }
  return discs;
}

}  // namespace

Html DrawHandMap(const Hand& hand, const std::vector<double>& force, const PlotText& text) {
  GRASPBENCH_DEMAND(hand.skin && force.size() == hand.skin->elements.size(), hand.id);
  const std::vector<MapDisc> discs = PlaceDiscs(hand);
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
  for (const MapDisc& disc : discs) {
    const bool is_first = &disc == &discs.front();
    left = is_first ? disc.x - disc.radius : std::min(left, disc.x - disc.radius);
    right = is_first ? disc.x + disc.radius : std::max(right, disc.x + disc.radius);
    top = is_first ? disc.y - disc.radius : std::min(top, disc.y - disc.radius);
    bottom = is_first ? disc.y + disc.radius : std::max(bottom, disc.y + disc.radius);
  }
  const double strongest = *std::max_element(force.begin(), force.end());
  Html content;
  for (const MapDisc& disc : discs) {
    const double f = force[disc.element];
    const std::string& link = hand.links[hand.skin->elements[disc.element].link].name;
    content += Element("ellipse",
                       {{"class", "cell"},
                        {"cx", Px(disc.x - left + kPlotGap)},
                        {"cy", Px(disc.y - top + kPlotGap)},
                        {"rx", Px(disc.radius * disc.width)},
                        {"ry", Px(disc.radius)},
                        {"fill-opacity", FormatFixed(strongest > 0.0 ? f / strongest : 0.0, 2)}},
                       Hint(link + ": " + FormatFixed(f, 2) + " N"));
  }
  return Svg("img", right - left + 2.0 * kPlotGap, bottom - top + 2.0 * kPlotGap, text, content);
}

}  // namespace graspbench
