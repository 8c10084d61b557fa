#include "reports/scenes/sight_picture.h"

#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCross = 5.0;  // [px]

/** From the level plane through O into the drawing. */
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
  text.title = "The " + name + " as the camera sees it";
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
