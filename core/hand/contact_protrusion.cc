#include "core/hand/contact_protrusion.h"

#include "core/shape/protrusion.h"

namespace graspbench {

double CalcContactProtrusion(const std::vector<CollisionShape>& shapes,
                             const std::vector<TriMesh>& surface) {
  Hand alone;
  for (const CollisionShape& shape : shapes) AddContact(shape, false, alone);
  std::vector<Ball> balls;  // the ends of the capsules that the shapes' balls lie in
  for (const LinkCapsule& capsule : alone.capsules) {
    balls.push_back({capsule.p_LA, capsule.radius});
    if (capsule.p_LB != capsule.p_LA) balls.push_back({capsule.p_LB, capsule.radius});
  }
  std::vector<Eigen::Vector3d> points;
  for (const TriMesh& mesh : surface) {
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  return CalcProtrusion(points, balls);
}

std::vector<LinkProtrusion> CalcContactProtrusions(const Hand& hand) {
  std::vector<std::vector<Ball>> balls(hand.links.size());
  for (const ContactSphere& ball : hand.contact_spheres) {
    balls[ball.link].push_back({ball.p_LS, ball.radius});
  }
  std::vector<std::vector<Eigen::Vector3d>> points(hand.links.size());
  for (const LinkVisual& visual : hand.visuals) {
    points[visual.link].insert(points[visual.link].end(), visual.mesh.vertices.begin(),
                               visual.mesh.vertices.end());
  }
  std::vector<LinkProtrusion> protrusions;
  for (size_t link = 0; link < hand.links.size(); ++link) {
    if (balls[link].empty() || points[link].empty()) continue;
    protrusions.push_back({hand.links[link].name, CalcProtrusion(points[link], balls[link])});
  }
  return protrusions;
}

}  // namespace graspbench
