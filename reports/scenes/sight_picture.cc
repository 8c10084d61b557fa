#include "reports/scenes/sight_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/tactile.h"

namespace graspbench {

namespace {

constexpr double kPixelsPerMetre = 2600.0;
constexpr double kNarrowest = 0.3;  // least drawn width of a disc seen from the side, as a share of
                                    // its full width

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

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCross = 5.0;  // [px]

/** Projects points of the horizontal plane through O into the drawing. */
class SightPlane {
 public:
  SightPlane(const Lens& lens, const Pose& X_WK, double middle)
      : lens_(lens), X_KW_(X_WK.inverse()), middle_(middle) {}
  Vector2d Show(const Vector2d& p) const {
    return kSightWidth / lens_.width * Project(lens_, X_KW_ * Vector3d(p.x(), p.y(), middle_));
  }
  Html DrawPolygon(const char* css_class, const std::vector<Vector2d>& points) const {
    std::string list;
    for (const Vector2d& p : points) {
      const Vector2d shown = Show(p);
      list += (list.empty() ? "" : " ") + Px(shown.x()) + "," + Px(shown.y());
    }
    return Element("polygon", {{"class", css_class}, {"points", list}});
  }

 private:
  Lens lens_;
  Pose X_KW_;
  double middle_;
};

Vector2d Direct(double angle) { return Vector2d(std::cos(angle), std::sin(angle)); }

Html DrawFound(const SightPlane& plane, const Sighting& found) {
  const Rectangle& box = found.rectangle;
  const Vector2d along = 0.5 * box.length * Direct(box.direction);
  const Vector2d across = 0.5 * box.width * Direct(box.direction + 0.5 * kPi);
  const Vector2d O(found.pose.x, found.pose.y);
  const Vector2d half = 0.6 * box.length * Direct(found.pose.yaw);
  const Vector2d start = plane.Show(O - half), end = plane.Show(O + half), middle = plane.Show(O);
  return plane.DrawPolygon("sight outline", found.outline) +
         plane.DrawPolygon("sight rectangle",
                           {box.centre + along + across, box.centre + along - across,
                            box.centre - along - across, box.centre - along + across}) +
         Line("sight axis", start.x(), start.y(), end.x(), end.y()) +
         Line("sight axis", middle.x() - kCross, middle.y() - kCross, middle.x() + kCross,
              middle.y() + kCross) +
         Line("sight axis", middle.x() - kCross, middle.y() + kCross, middle.x() + kCross,
              middle.y() - kCross);
}

}  // namespace

Html DrawSight(WristCamera& camera, const GraspObject& object, const Pose& X_WO,
               const Eigen::VectorXd& q, const PlanarPose& supposed, const std::string& name) {
  const Pose X_WK = camera.CalcLookPose(supposed);
  const uint64_t seed = 1;
  const Image empty = camera.TakePicture(camera.MakeScene(X_WK, q, nullptr), X_WK, nullptr);
  const Image picture = camera.TakePicture(camera.MakeScene(X_WK, q, &X_WO), X_WK, &seed);
  const OutlineModel outline(object.mesh);
  const Sighting found = LocateObject(picture, empty, camera.lens(), X_WK, outline, supposed);
  const double height = kSightWidth * camera.lens().height / camera.lens().width;
  PlotText text;
  text.title = "The " + name + " in the camera picture";
  text.description =
      found.is_found ? "Found, with its outline." : "Not found: " + found.reason + ".";
  Html content = Element("image", {{"href", MakeDataUri("image/webp", EncodeWebp(picture))},
                                   {"width", Px(kSightWidth)},
                                   {"height", Px(height)}});
  if (found.is_found) {
    content += DrawFound(SightPlane(camera.lens(), X_WK, outline.middle()), found);
  }
  return Element(
      "div", {},
      Svg("img", kSightWidth, height, text, content) +
          Element("p", {}, name + (found.is_found ? "" : ": not found, " + found.reason)));
}

}  // namespace graspbench
