#include "core/physics/table_support.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>

#include "core/base/units.h"
#include "core/physics/mesh_outline.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Number of directions in which the object's outermost vertices are searched. */
constexpr int kSupportDirections = 4000;
/** Vertices this much higher than the lowest one do not carry the object [m]. */
constexpr double kSupportBand = 2e-4;
/** Vertices lower than this may carry the whole object. The outermost of them are contacts, even if
others lie farther out and higher; otherwise the object would sink to those [m]. */
constexpr double kBearingBand = 2e-5;
/** Faces of a smooth part meet at a smaller angle; 16 segments: 22.5 degrees. */
const double kSmoothCosine = std::cos(RadFromDeg(25.0));
/** Longest edge on a ball over its radius; 16 segments: 0.39, and 0.55 along the diagonal. The
corners of a long cylinder also lie on a sphere, but its faces do not. */
constexpr double kLongestEdge = 0.6;
/** Largest distance of a point from a fitted ball over the height of the ball's cap that ends
there: the surface must curve equally in all directions. */
constexpr double kFitShare = 0.05;
/** Triangles whose normals and planes differ by less are one face. */
constexpr double kFlatCosine = 1.0 - 1e-6;
constexpr double kFlatBand = 2e-5;  ///< [m]
/** Smaller faces are ignored, as a share of the object's radius squared. */
constexpr double kLeastFace = 0.01;
/** An object stands on a face that is level to within a degree. */
const double kLevelCosine = std::cos(RadFromDeg(1.0));
/** Balls that differ by less than this share of their radius are one. */
constexpr double kSameBall = 0.02;

/** Returns the vertices that can touch a plane: the outermost ones in a Fibonacci lattice of
directions. */
std::vector<size_t> FindSupportVertices(const TriMesh& mesh) {
  // a Fibonacci number: directions that far apart in the list are neighbours
  constexpr size_t kStride = 89;
  const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3d> directions;
  for (int k = 0; k < kSupportDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kSupportDirections;
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(golden_angle * k), r * std::sin(golden_angle * k), z);
  }
  std::vector<size_t> chosen = FindOutermostVertices(mesh.vertices, directions, kStride);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

/** Finds faces by their normals: equal normals lie in the same or a neighbouring cell of a grid. */
class FaceFinder {
 public:
  void Add(const Vector3d& normal, int face) { faces_[CalcKey(CalcCell(normal))].push_back(face); }
  /** Returns the first face for which is_same is true; -1 when there is none. */
  template <typename IsSame>
  int Find(const Vector3d& normal, const IsSame& is_same) const {
    int first = -1;
    const Eigen::Vector3i cell = CalcCell(normal);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          faces_.find(CalcKey(cell + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
      if (found == faces_.end()) continue;
      for (const int face : found->second) {
        if ((first < 0 || face < first) && is_same(face)) first = face;
      }
    }
    return first;
  }

 private:
  /** Wider than the distance of unit vectors within kFlatCosine. */
  static constexpr double kCellWidth = 2e-3;
  static_assert(kCellWidth * kCellWidth > 2.0 * (1.0 - kFlatCosine));

  static Eigen::Vector3i CalcCell(const Vector3d& normal) {
    return (normal / kCellWidth).array().floor().cast<int>().matrix();
  }
  static int64_t CalcKey(const Eigen::Vector3i& cell) {
    constexpr int64_t kMostCells = 2048;  // along an axis
    return (cell.x() * kMostCells + cell.y()) * kMostCells + cell.z();
  }

  std::unordered_map<int64_t, std::vector<int>> faces_;
};

struct FittedBall {
  Vector3d centre;
  double radius;
};

/** Fits the sphere |p|^2 = 2 c.p + w through points relative to the first one, by least squares.
Returns nothing when they do not lie on a sphere. */
std::optional<FittedBall> FitBall(const std::vector<Vector3d>& points) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double size = 0.0;
  for (const Vector3d& p : points) size = std::max(size, (p - points[0]).norm());
  for (const Vector3d& p : points) {
    const Vector3d scaled = (p - points[0]) / size;
    Eigen::Vector4d row;
    row << 2.0 * scaled, 1.0;
    A += row * row.transpose();
    b += row * scaled.squaredNorm();
  }
  const Eigen::LDLT<Eigen::Matrix4d> factor(A);
  // Coplanar points lie on many spheres or on none.
  if (factor.info() != Eigen::Success || factor.vectorD().minCoeff() < 1e-9) return std::nullopt;
  const Eigen::Vector4d solution = factor.solve(b);
  const Vector3d centre = solution.head<3>();
  const double radius = std::sqrt(centre.squaredNorm() + solution[3]);
  if (!std::isfinite(radius)) return std::nullopt;
  double nearest = 1.0;
  for (size_t i = 1; i < points.size(); ++i) {
    nearest = std::min(nearest, (points[i] - points[0]).norm() / size);
  }
  for (const Vector3d& p : points) {
    const Vector3d scaled = (p - points[0]) / size;
    const double cap_height = 0.5 * std::max(scaled.squaredNorm(), nearest * nearest) / radius;
    if (std::abs((scaled - centre).norm() - radius) > kFitShare * cap_height) return std::nullopt;
  }
  return FittedBall{points[0] + size * centre, size * radius};
}

/** Signed integral of the distance from the origin over the triangle with corners 0, a, b. */
double IntegrateDistance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length = edge.norm();
  const double twice_area = a.x() * b.y() - a.y() * b.x();
  if (length == 0.0 || twice_area == 0.0) return 0.0;
  const double d = std::abs(twice_area) / length;  // of the edge
  // With t the tangent of the angle from the perpendicular, r reaches d sec: the integral of d^3
  // sec^3 / 3 is d^3 (t sqrt(1 + t^2) + asinh t) / 6.
  const auto primitive = [](double t) { return t * std::sqrt(1.0 + t * t) + std::asinh(t); };
  const double t_a = a.dot(edge) / length / d, t_b = b.dot(edge) / length / d;
  return std::copysign(d * d * d / 6.0 * (primitive(t_b) - primitive(t_a)), twice_area);
}

}  // namespace

std::shared_ptr<const TableSupport> TableSupport::Of(const GraspObject& object) {
  static std::mutex mutex;
  static std::map<std::weak_ptr<const SignedDistanceField>, std::shared_ptr<const TableSupport>,
                  std::owner_less<>>
      known;
  if (!object.field) return std::make_shared<const TableSupport>(object.mesh);
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto found = known.find(object.field); found != known.end()) return found->second;
  }
  auto made = std::make_shared<const TableSupport>(object.mesh);
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto entry = known.begin(); entry != known.end();) {
    entry = entry->first.expired() ? known.erase(entry) : std::next(entry);
  }
  return known.emplace(object.field, made).first->second;
}

TableSupport::TableSupport(const TriMesh& mesh) {
  const std::vector<size_t> vertices = FindSupportVertices(mesh);
  for (size_t i : vertices) {
    points_.push_back({mesh.vertices[i]});
    radius_ = std::max(radius_, mesh.vertices[i].norm());
  }
  FindBalls(mesh, vertices);
  FindCircles(mesh, vertices);
  FindFaces(mesh);
}

void TableSupport::FindCircles(const TriMesh& mesh, const std::vector<size_t>& vertices) {
  std::vector<bool> outermost(mesh.vertices.size(), false);
  std::vector<int> point_of_vertex(mesh.vertices.size(), -1);
  for (size_t k = 0; k < vertices.size(); ++k) {
    point_of_vertex[vertices[k]] = static_cast<int>(k);
    outermost[vertices[k]] = points_[k].ball < 0;  // a ball is the better support
  }
  for (const RimCircle& rim : FindRimCircles(mesh, outermost)) {
    for (const size_t vertex : rim.vertices) {
      points_[static_cast<size_t>(point_of_vertex[vertex])].circle =
          static_cast<int>(circles_.size());
    }
    circles_.push_back({rim.p_OCentre, rim.axis_O, rim.radius});
  }
}

std::optional<Vector3d> TableSupport::FindLowestOf(const Circle& circle, const Vector3d& up_O) {
  const Vector3d across = up_O - up_O.dot(circle.axis_O) * circle.axis_O;
  const double share = across.norm();  // sine of its tilt
  // A level rim touches all around: its vertices carry the object.
  if (2.0 * circle.radius * share < kSupportBand) return std::nullopt;
  return Vector3d(circle.p_OCentre - circle.radius / share * across);
}

void TableSupport::FindFaces(const TriMesh& mesh) {
  std::vector<std::vector<Eigen::Vector3i>> triangles;  // by face
  FaceFinder finder;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d& p = mesh.vertices[t[0]];
    const Vector3d cross = (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p);
    if (cross.norm() == 0.0) continue;
    const Vector3d normal = cross.normalized();
    int index = finder.Find(normal, [&](int other) {
      const Face& face = faces_[static_cast<size_t>(other)];
      return face.normal_O.dot(normal) > kFlatCosine &&
             std::abs(face.offset - normal.dot(p)) < kFlatBand;
    });
    if (index < 0) {
      // An object cannot stand on a plane that cuts it.
      const double offset = normal.dot(p);
      const bool is_outermost = std::all_of(
          points_.begin(), points_.end(),
          [&](const Point& point) { return normal.dot(point.p_O) <= offset + kFlatBand; });
      if (!is_outermost) continue;
      index = static_cast<int>(faces_.size());
      faces_.push_back({normal, offset, 0.0, Vector3d::Zero(), 0.0});
      triangles.emplace_back();
      finder.Add(normal, index);
    }
    Face& face = faces_[static_cast<size_t>(index)];
    const double area = 0.5 * cross.norm();
    face.area += area;
    face.p_OCentroid += area / 3.0 * (p + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
    triangles[static_cast<size_t>(index)].push_back(t);
  }
  for (size_t f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    face.p_OCentroid /= face.area;
    const Vector3d e1 = face.normal_O.unitOrthogonal(), e2 = face.normal_O.cross(e1);
    const auto flatten = [&](int vertex) -> Eigen::Vector2d {
      const Vector3d p = mesh.vertices[vertex] - face.p_OCentroid;
      return {e1.dot(p), e2.dot(p)};
    };
    for (const Eigen::Vector3i& t : triangles[f]) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) {
        sum += IntegrateDistance(flatten(t[k]), flatten(t[(k + 1) % 3]));
      }
      face.mean_distance += sum / face.area;
    }
  }
  const double least_area = kLeastFace * radius_ * radius_;
  faces_.erase(std::remove_if(faces_.begin(), faces_.end(),
                              [&](const Face& face) { return face.area < least_area; }),
               faces_.end());
}

void TableSupport::FindBalls(const TriMesh& mesh, const std::vector<size_t>& vertices) {
  std::vector<std::vector<size_t>> faces(mesh.vertices.size());
  std::vector<Vector3d> normals;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    for (int corner : {t[0], t[1], t[2]}) {
      faces[static_cast<size_t>(corner)].push_back(normals.size());
    }
    normals.push_back(normal.normalized());
  }
  for (size_t k = 0; k < vertices.size(); ++k) {
    const size_t vertex = vertices[k];
    Vector3d outwards = Vector3d::Zero();
    std::set<size_t> around;
    for (size_t face : faces[vertex]) {
      outwards += normals[face];
      const Eigen::Vector3i& t = mesh.triangles[face];
      for (int corner : {t[0], t[1], t[2]}) around.insert(static_cast<size_t>(corner));
    }
    outwards.normalize();
    const bool is_smooth =
        std::all_of(faces[vertex].begin(), faces[vertex].end(),
                    [&](size_t face) { return normals[face].dot(outwards) > kSmoothCosine; });
    std::vector<Vector3d> ring = {mesh.vertices[vertex]};
    for (size_t i : around) {
      if (i != vertex) ring.push_back(mesh.vertices[i]);
      points_[k].neighbourhood =
          std::max(points_[k].neighbourhood, (mesh.vertices[i] - ring[0]).norm());
    }
    const std::optional<FittedBall> ball = is_smooth ? FitBall(ring) : std::nullopt;
    if (!ball || points_[k].neighbourhood > kLongestEdge * ball->radius ||
        (ring[0] - ball->centre).dot(outwards) < 0.0) {
      continue;
    }
    const auto same = std::find_if(balls_.begin(), balls_.end(), [&](const Ball& other) {
      return (other.p_OCentre - ball->centre).norm() < kSameBall * other.radius &&
             std::abs(other.radius - ball->radius) < kSameBall * other.radius;
    });
    points_[k].ball = static_cast<int>(same - balls_.begin());
    if (same == balls_.end()) balls_.push_back({ball->centre, ball->radius});
  }
}

bool TableSupport::IsOnBall(const Point& point, const Pose& X_WO) const {
  if (point.ball < 0) return false;
  const Ball& ball = balls_[static_cast<size_t>(point.ball)];
  const Vector3d p_OLowest = ball.p_OCentre - ball.radius * X_WO.linear().row(2).transpose();
  return (p_OLowest - point.p_O).norm() <= point.neighbourhood;
}

void TableSupport::AddOutermost(const Vector3d& up_O, double most,
                                const std::vector<Candidate>& candidates,
                                std::vector<int>& chosen) {
  // Fixed directions in O keep the choice stable from step to step.
  const Vector3d e1 = up_O.unitOrthogonal(), e2 = up_O.cross(e1);
  for (int k = 0; k < kNumDirections; ++k) {
    const double angle = 2.0 * kPi * k / kNumDirections;
    const Vector3d direction = std::cos(angle) * e1 + std::sin(angle) * e2;
    int best = -1;
    double farthest = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < candidates.size(); ++i) {
      const double distance = direction.dot(candidates[i].p_O);
      if (candidates[i].height > most || distance <= farthest) continue;
      farthest = distance;
      best = static_cast<int>(i);
    }
    if (std::find(chosen.begin(), chosen.end(), best) == chosen.end()) chosen.push_back(best);
  }
}

double TableSupport::CalcFaceFactor(const Vector3d& up_O, const std::vector<Candidate>& candidates,
                                    const std::vector<int>& chosen) const {
  if (chosen.size() < 2) return 1.0;
  if (chosen.size() == 2) return 0.5;
  const auto face = std::find_if(faces_.begin(), faces_.end(), [&](const Face& candidate) {
    return -candidate.normal_O.dot(up_O) > kLevelCosine;
  });
  if (face == faces_.end()) return 1.0;
  double mean = 0.0;
  for (int point : chosen) {
    const Vector3d p = candidates[static_cast<size_t>(point)].p_O - face->p_OCentroid;
    mean += (p - p.dot(up_O) * up_O).norm() / static_cast<double>(chosen.size());
  }
  return std::min(1.0, face->mean_distance / mean);
}

void TableSupport::FindContacts(const Pose& X_WO, double reach, std::vector<Contact>& contacts,
                                double& face_factor) const {
  contacts.clear();
  face_factor = 1.0;
  const double height_O = X_WO.translation().z();
  if (height_O > radius_ + reach) return;
  const Vector3d up_O = X_WO.linear().row(2).transpose();
  thread_local std::vector<std::optional<Vector3d>> p_OLowest;  // of rolling circles
  p_OLowest.clear();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Circle& circle : circles_) {
    p_OLowest.push_back(FindLowestOf(circle, up_O));
    if (p_OLowest.back()) lowest = std::min(lowest, height_O + up_O.dot(*p_OLowest.back()));
  }
  thread_local std::vector<double> heights;
  heights.resize(points_.size());
  for (size_t i = 0; i < points_.size(); ++i) {
    heights[i] = height_O + up_O.dot(points_[i].p_O);
    lowest = std::min(lowest, heights[i]);
  }
  if (lowest > reach) return;

  thread_local std::vector<bool> ball_carries;
  ball_carries.assign(balls_.size(), false);
  for (size_t i = 0; i < points_.size(); ++i) {
    if (heights[i] > lowest + kSupportBand || !IsOnBall(points_[i], X_WO)) continue;
    ball_carries[static_cast<size_t>(points_[i].ball)] = true;
  }
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  for (size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (heights[i] > lowest + kSupportBand) continue;
    if (point.ball >= 0 && ball_carries[static_cast<size_t>(point.ball)]) continue;
    if (point.circle >= 0 && p_OLowest[static_cast<size_t>(point.circle)]) continue;
    candidates.push_back({static_cast<int>(i), point.p_O, heights[i], false});
  }
  for (size_t c = 0; c < circles_.size(); ++c) {
    if (!p_OLowest[c]) continue;
    const double height = height_O + up_O.dot(*p_OLowest[c]);
    if (height > lowest + kSupportBand) continue;
    const auto id = static_cast<int>(points_.size() + balls_.size() + c);
    candidates.push_back({id, *p_OLowest[c], height, true});
  }
  thread_local std::vector<int> chosen;
  chosen.clear();
  if (!candidates.empty()) {
    AddOutermost(up_O, lowest + kBearingBand, candidates, chosen);
    AddOutermost(up_O, lowest + kSupportBand, candidates, chosen);
    chosen.erase(std::remove(chosen.begin(), chosen.end(), -1), chosen.end());
  }
  face_factor = CalcFaceFactor(up_O, candidates, chosen);
  for (const int i : chosen) {
    const Candidate& candidate = candidates[static_cast<size_t>(i)];
    contacts.push_back({candidate.id, X_WO * candidate.p_O, false, candidate.rolls});
  }
  for (size_t b = 0; b < balls_.size(); ++b) {
    if (!ball_carries[b]) continue;
    const Vector3d p_W = X_WO * balls_[b].p_OCentre - balls_[b].radius * Vector3d::UnitZ();
    contacts.push_back({static_cast<int>(points_.size() + b), p_W, true, true});
  }
}

double TableSupport::CalcLowestPoint(const Pose& X_WO) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    lowest = std::min(lowest, (X_WO * point.p_O).z());
    if (!IsOnBall(point, X_WO)) continue;
    const Ball& ball = balls_[static_cast<size_t>(point.ball)];
    lowest = std::min(lowest, (X_WO * ball.p_OCentre).z() - ball.radius);
  }
  const Vector3d up_O = X_WO.linear().row(2).transpose();
  for (const Circle& circle : circles_) {
    const std::optional<Vector3d> p_O = FindLowestOf(circle, up_O);
    if (p_O) lowest = std::min(lowest, (X_WO * *p_O).z());
  }
  return lowest;
}

}  // namespace graspbench
