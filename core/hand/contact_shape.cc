#include "core/hand/contact_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {

using Eigen::Vector3d;

ClosestPoints FindClosestPoints(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                                const Vector3d& b1) {
  const Vector3d da = a1 - a0, db = b1 - b0, r = a0 - b0;
  const double aa = da.squaredNorm(), bb = db.squaredNorm(), br = db.dot(r);
  constexpr double kPoint = 1e-18;
  double s = 0.0, t = 0.0;
  if (aa <= kPoint) {
    t = bb <= kPoint ? 0.0 : std::clamp(br / bb, 0.0, 1.0);
  } else {
    const double ar = da.dot(r);
    if (bb <= kPoint) {
      s = std::clamp(-ar / aa, 0.0, 1.0);
    } else {
      const double ab = da.dot(db), denominator = aa * bb - ab * ab;
      s = denominator > kPoint ? std::clamp((ab * br - ar * bb) / denominator, 0.0, 1.0) : 0.0;
      t = (ab * s + br) / bb;
      if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((ab * t - ar) / aa, 0.0, 1.0);
      }
    }
  }
  return {a0 + s * da, b0 + t * db};
}

std::vector<CapsulePair> FindCapsulePairs(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  const std::vector<LinkCapsule>& capsules = hand.capsules;
  const auto are_apart = [&](int link, int other) {
    return std::any_of(hand.apart.begin(), hand.apart.end(), [&](const auto& pair) {
      return pair == std::pair(link, other) || pair == std::pair(other, link);
    });
  };
  std::vector<CapsulePair> pairs;
  for (int a = 0; a < static_cast<int>(capsules.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(capsules.size()); ++b) {
      const LinkCapsule &ca = capsules[a], &cb = capsules[b];
      if (hand.FindDigitOfLink(ca.link) == hand.FindDigitOfLink(cb.link)) continue;
      if (are_apart(ca.link, cb.link)) continue;
      const ClosestPoints rest =
          FindClosestPoints(X_HL[ca.link] * ca.p_LA, X_HL[ca.link] * ca.p_LB,
                            X_HL[cb.link] * cb.p_LA, X_HL[cb.link] * cb.p_LB);
      if ((rest.on_a - rest.on_b).norm() <= ca.radius + cb.radius) continue;
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL) {
  const LinkCapsule &a = hand.capsules[pair.a], &b = hand.capsules[pair.b];
  const ClosestPoints nearest = FindClosestPoints(X_HL[a.link] * a.p_LA, X_HL[a.link] * a.p_LB,
                                                  X_HL[b.link] * b.p_LA, X_HL[b.link] * b.p_LB);
  return (nearest.on_a - nearest.on_b).norm() - a.radius - b.radius;
}

namespace {

constexpr double kLeftOut = 5e-5;    // [m] of a point outside the hull of the corners
constexpr double kConverged = 1e-8;  // [m] of a distance
constexpr int kMostSteps = 100;
constexpr int kNumDirections = 400;

/** Corners of the hull, at most four, relative to the point whose distance is sought. */
struct Simplex {
  Vector3d corners[4];
  size_t indices[4] = {};
  int size = 0;
};

/** The point of a simplex nearest to the origin; the simplex keeps the corners of its face. */
Vector3d Reduce(Simplex& simplex) {
  Vector3d nearest = simplex.corners[0];
  int best = 1;
  for (int face = 1; face < 1 << simplex.size; ++face) {
    int at[4], size = 0;
    for (int k = 0; k < simplex.size; ++k) {
      if (face >> k & 1) at[size++] = k;
    }
    // The edges from the face's first corner a; unused columns stay unit vectors.
    const Vector3d a = simplex.corners[at[0]];
    Eigen::Matrix3d edges = Eigen::Matrix3d::Zero(), G = Eigen::Matrix3d::Identity();
    for (int i = 1; i < size; ++i) edges.col(i - 1) = simplex.corners[at[i]] - a;
    for (int i = 0; i < size - 1; ++i) {
      for (int k = 0; k < size - 1; ++k) G(i, k) = edges.col(i).dot(edges.col(k));
    }
    if (G.determinant() <= 1e-12 * G.diagonal().prod()) continue;  // flat: a smaller face has it
    const Vector3d shares = G.inverse() * (-edges.transpose() * a);
    if (shares.minCoeff() < 0.0 || shares.sum() > 1.0) continue;
    const Vector3d p = a + edges * shares;
    if (p.squaredNorm() >= nearest.squaredNorm()) continue;
    nearest = p;
    best = face;
  }
  int size = 0;
  for (int k = 0; k < simplex.size; ++k) {
    if ((best >> k & 1) == 0) continue;
    simplex.corners[size] = simplex.corners[k];
    simplex.indices[size++] = simplex.indices[k];
  }
  simplex.size = size;
  return nearest;
}

class Hull {
 public:
  explicit Hull(const std::vector<Vector3d>& points) {
    corners_ = {points.front()};
    for (const Vector3d& p : points) {
      for (;;) {
        const Vector3d out = FindWayOut(p, kLeftOut);
        if (out.norm() <= kLeftOut) break;
        const size_t farthest = FindFarthest(points, out);
        const size_t corner = FindFarthest(corners_, out);
        const bool is_new = out.dot(points[farthest] - corners_[corner]) > 0.0;
        corners_.push_back(is_new ? points[farthest] : p);
        if (!is_new) break;
      }
    }
  }

  /** From the hull's nearest point to p; any vector of at most `enough` where the distance is not
  more. Starts from the face that the last call found. */
  Vector3d FindWayOut(const Vector3d& p, double enough) {
    for (int k = 0; k < simplex_.size; ++k) {
      simplex_.corners[k] = corners_[simplex_.indices[k]] - p;
    }
    if (simplex_.size == 0) Add(0, p);
    Vector3d nearest = Reduce(simplex_);
    for (int step = 0; step < kMostSteps && nearest.norm() > enough; ++step) {
      const size_t farthest = FindFarthest(corners_, -nearest);
      const double gain = nearest.squaredNorm() - nearest.dot(corners_[farthest] - p);
      if (gain <= kConverged * nearest.norm() || simplex_.size == 4) break;
      Add(farthest, p);
      const Vector3d nearer = Reduce(simplex_);
      if (nearer.norm() >= nearest.norm()) break;
      nearest = nearer;
    }
    return -nearest;
  }

 private:
  void Add(size_t corner, const Vector3d& p) {
    simplex_.indices[simplex_.size] = corner;
    simplex_.corners[simplex_.size++] = corners_[corner] - p;
  }
  static size_t FindFarthest(const std::vector<Vector3d>& points, const Vector3d& direction) {
    size_t farthest = 0;
    double most = direction.dot(points[0]);
    for (size_t i = 1; i < points.size(); ++i) {
      const double extent = direction.dot(points[i]);
      if (extent <= most) continue;
      most = extent;
      farthest = i;
    }
    return farthest;
  }

  std::vector<Vector3d> corners_;
  Simplex simplex_;
};

/** Unit vectors, evenly spread: a Fibonacci lattice. */
std::vector<Vector3d> SpreadDirections() {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (int i = 0; i < kNumDirections; ++i) {
    const double z = (2.0 * i + 1.0) / kNumDirections - 1.0, across = std::sqrt(1.0 - z * z);
    directions.emplace_back(across * std::cos(golden * i), across * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace

double CalcProtrusion(const std::vector<Vector3d>& points, const std::vector<Ball>& balls) {
  Hull hull(points);
  const std::vector<Vector3d> directions = SpreadDirections();
  double most = 0.0;
  for (const Ball& ball : balls) {
    for (const Vector3d& direction : directions) {
      Vector3d out = hull.FindWayOut(ball.centre + ball.radius * direction, most);
      while (out.norm() > most + kConverged) {
        most = out.norm();
        out = hull.FindWayOut(ball.centre + ball.radius / most * out, most);
      }
    }
  }
  return most;
}

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

namespace {

// Distance of neighbouring balls in radii; the surface dips by r - sqrt(r^2 - (d/2)^2).
constexpr double kSpacing = 1.5;
constexpr double kPadSpacing = 0.8;

/** Positions along [-half, half], symmetric, at most `spacing` apart. */
std::vector<double> Spread(double half, double spacing) {
  const int num_gaps = static_cast<int>(std::ceil(2.0 * half / spacing - 1e-9));
  if (num_gaps <= 0) return {0.0};
  std::vector<double> positions;
  for (int i = 0; i <= num_gaps; ++i) positions.push_back(half * (2.0 * i / num_gaps - 1.0));
  return positions;
}

/** Rows of balls along the axis `along`, side by side along the axis `wide`, in the middle plane.
 */
void AddRows(const CollisionShape& shape, double radius, int along, int wide, bool is_pad,
             Hand& hand) {
  const double spacing = (is_pad ? kPadSpacing : kSpacing) * radius;
  const double half_along = shape.size[along] / 2.0 - radius;
  for (double across : Spread(shape.size[wide] / 2.0 - radius, spacing)) {
    const auto place = [&](double position) -> Eigen::Vector3d {
      Eigen::Vector3d p_SP = Eigen::Vector3d::Zero();
      p_SP[wide] = across;
      p_SP[along] = position;
      return shape.X_LS * p_SP;
    };
    for (double position : Spread(half_along, spacing)) {
      hand.contact_spheres.push_back({shape.link, place(position), radius});
    }
    if (shape.is_cover) continue;
    hand.capsules.push_back({shape.link, place(-half_along), place(half_along), radius});
  }
}

}  // namespace

void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand) {
  const bool is_disc =
      shape.kind == CollisionShape::Kind::kCylinder && shape.size.z() < shape.size.x();
  if (is_disc || shape.kind == CollisionShape::Kind::kBox) {
    CollisionShape box = shape;
    if (is_disc) box.size.head<2>() *= std::sqrt(kPi) / 2.0;
    int thin, along;
    const double thickness = box.size.minCoeff(&thin);
    box.size.maxCoeff(&along);
    if (along == thin) along = (thin + 1) % 3;  // a cube
    AddRows(box, thickness / 2.0, along, 3 - thin - along, is_pad, hand);
  } else {
    AddRows(shape, shape.size.x() / 2.0, 2, 0, is_pad, hand);
  }
}

}  // namespace graspbench
