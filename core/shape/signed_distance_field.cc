#include "core/shape/signed_distance_field.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/base/error.h"
#include "core/base/files/kept.h"
#include "core/shape/line_crossings.h"
#include "core/shape/tri_mesh.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {
namespace {

// Extraction of the part of a mesh that bounds its solid (line_crossings.h).
/** Returns the triangles with the solid on one side only, without those inside it, where parts
overlap or touch. A triangle that is partly inside is cut, until the pieces are shorter than
`resolution` [m]. The pieces no longer share edges: the result is for distances, not a closed mesh.
@pre every edge has as many triangles in either direction. */
TriMesh FindExposedSurface(const TriMesh& mesh, double resolution);

constexpr double kSameSurface = 1e-7;  // [m] nothing lies between sheets that are closer than this

class Exposer {
 public:
  Exposer(const TriMesh& mesh, double resolution)
      : lines_{LineCrossings(mesh, 0), LineCrossings(mesh, 1), LineCrossings(mesh, 2)},
        resolution_(resolution) {}

  void Add(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    int num_exposed = IsExposed(middle, normal) ? 1 : 0;
    for (const Eigen::Vector3d& corner : corners) {
      if (IsExposed(0.9 * corner + 0.1 * middle, normal)) ++num_exposed;
    }
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).norm());
    }
    if (num_exposed == 4 || (num_exposed > 0 && longest < resolution_)) {
      const int first = exposed_.num_vertices();
      exposed_.vertices.insert(exposed_.vertices.end(), corners.begin(), corners.end());
      exposed_.triangles.emplace_back(first, first + 1, first + 2);
    } else if (num_exposed > 0) {
      const Eigen::Vector3d &a = corners[0], &b = corners[1], &c = corners[2];
      const Eigen::Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      for (const auto& part :
           {std::array<Eigen::Vector3d, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        Add(part);
      }
    }
  }
  TriMesh TakeMesh() { return std::move(exposed_); }

 private:
  // Whether the solid is on one side only of this point of the surface, along the axis closest to
  // the normal.
  bool IsExposed(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    lines_[axis].Find(p[(axis + 1) % 3], p[(axis + 2) % 3], crossings_);
    int below = 0, above = 0;
    for (const LineCrossings::Crossing& crossing : crossings_) {
      if (crossing.at < p[axis] - kSameSurface) below += crossing.winding;
      if (crossing.at < p[axis] + kSameSurface) above += crossing.winding;
    }
    return (below >= 1) != (above >= 1);
  }

  std::array<LineCrossings, 3> lines_;
  double resolution_;
  std::vector<LineCrossings::Crossing> crossings_;
  TriMesh exposed_;
};

TriMesh FindExposedSurface(const TriMesh& mesh, double resolution) {
  Exposer exposer(mesh, resolution);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    exposer.Add({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  return exposer.TakeMesh();
}

}  // namespace

namespace {

// Increase when the stored layout or the rule that fills it changes.
constexpr char kCacheKind[] = "gbsdf002";

// Columns are offset from the nodes by this, where no edge of a drawn mesh lies.
const Eigen::Vector2d kBeside(1.0e-9, 1.6180339887e-9);  // [m]
constexpr double kThinnest = 1e-6;                       // [m] sheets closer than this may touch

// Finds the nodes inside the solid, column by column along z.
class InsideFinder {
 public:
  explicit InsideFinder(const TriMesh& mesh) : lines_(mesh, 2) {}

  // Sets inside[k] for the node at z = lower + k * cell.
  void FindColumn(double x, double y, double lower, double cell, std::vector<bool>& inside) {
    lines_.Find(x + kBeside.x(), y + kBeside.y(), crossings_);
    int winding = 0;
    size_t next = 0;
    for (size_t k = 0; k < inside.size(); ++k) {
      const double z = lower + cell * static_cast<double>(k);
      for (; next < crossings_.size() && crossings_[next].at < z; ++next) {
        winding += crossings_[next].winding;
      }
      inside[k] = winding >= 1;
    }
    winding = 0;
    for (size_t i = 0; i < crossings_.size(); ++i) {
      winding += crossings_[i].winding;
      has_overlap_ = has_overlap_ || winding < 0 || winding > 1 ||
                     (i > 0 && crossings_[i].at - crossings_[i - 1].at < kThinnest);
    }
  }
  // Whether any column passed through parts that overlap or touch.
  bool has_overlap() const { return has_overlap_; }

 private:
  LineCrossings lines_;
  std::vector<LineCrossings::Crossing> crossings_;
  bool has_overlap_ = false;
};

// Precedes the values in a cache file.
struct CacheHeader {
  double lower[3];
  double cell;
  int32_t num_nodes[3];
  int32_t padding;
};
static_assert(sizeof(CacheHeader) == 48);

std::filesystem::path FindCacheFile(const std::filesystem::path& folder, uint64_t mesh_hash) {
  return folder / fmt::format("{:016x}.sdf", mesh_hash);
}

}  // namespace

SignedDistanceField SignedDistanceField::Build(const TriMesh& mesh) {
  GRASPBENCH_DEMAND(!mesh.triangles.empty(), "a mesh without triangles has no distance");
  const Eigen::AlignedBox3d box = CalcBounds(mesh);
  const Eigen::Vector3d covered = box.sizes() + Eigen::Vector3d::Constant(2.0 * kMargin);

  SignedDistanceField field;
  field.lower_ = box.min() - Eigen::Vector3d::Constant(kMargin);
  field.cell_ = std::max(kMinCell, std::cbrt(covered.prod() / kMaxNodes));
  field.num_nodes_ = (covered / field.cell_).array().ceil().cast<int>() + 1;
  field.values_.resize(static_cast<size_t>(field.num_nodes_.cast<int64_t>().prod()));

  const Eigen::Vector3i& n = field.num_nodes_;
  InsideFinder finder(mesh);
  std::vector<bool> is_inside(field.values_.size()), column(n.z());
  for (int j = 0; j < n.y(); ++j) {
    for (int i = 0; i < n.x(); ++i) {
      const Eigen::Vector3d p = field.lower_ + field.cell_ * Eigen::Vector3d(i, j, 0);
      finder.FindColumn(p.x(), p.y(), p.z(), field.cell_, column);
      for (int k = 0; k < n.z(); ++k) is_inside[field.FindIndex({i, j, k})] = column[k];
    }
  }
  field.CalcValues(mesh, is_inside, false);
  if (finder.has_overlap()) {
    field.CalcValues(FindExposedSurface(mesh, field.cell_), is_inside, true);
  }
  return field;
}

// A straight path to a hidden surface crosses an exposed one first from outside, but not from
// inside.
void SignedDistanceField::CalcValues(const TriMesh& mesh, const std::vector<bool>& is_inside,
                                     bool only_inside) {
  const TriangleTree tree(mesh);
  int nearest_triangle = 0;  // of the previous node: an excellent first guess
  for (int k = 0; k < num_nodes_.z(); ++k) {
    for (int j = 0; j < num_nodes_.y(); ++j) {
      for (int i = 0; i < num_nodes_.x(); ++i) {
        const size_t index = FindIndex({i, j, k});
        if (only_inside && !is_inside[index]) continue;
        const Eigen::Vector3d p = lower_ + cell_ * Eigen::Vector3d(i, j, k);
        const TriangleTree::Nearest nearest = tree.FindNearest(p, nearest_triangle);
        nearest_triangle = nearest.triangle;
        const double distance = std::sqrt(nearest.squared_distance);
        values_[index] = static_cast<float>(is_inside[index] ? -distance : distance);
      }
    }
  }
}

std::string SignedDistanceField::FormatCache() const {
  CacheHeader header = {};
  Eigen::Map<Eigen::Vector3d>(header.lower) = lower_;
  header.cell = cell_;
  Eigen::Map<Eigen::Vector3i>(header.num_nodes) = num_nodes_;
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(reinterpret_cast<const char*>(values_.data()), values_.size() * sizeof(float));
  return bytes;
}

bool SignedDistanceField::ParseCache(const std::string& bytes) {
  CacheHeader header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  lower_ = Eigen::Map<const Eigen::Vector3d>(header.lower);
  cell_ = header.cell;
  num_nodes_ = Eigen::Map<const Eigen::Vector3i>(header.num_nodes);
  const size_t size = bytes.size() - sizeof header;
  if (!lower_.allFinite() || !std::isfinite(cell_) || !(cell_ >= kMinCell) ||
      (num_nodes_.array() < 2).any() || (num_nodes_.array() > kMaxNodes).any() ||
      static_cast<size_t>(num_nodes_.cast<int64_t>().prod()) * sizeof(float) != size) {
    return false;
  }
  values_.resize(size / sizeof(float));
  std::memcpy(values_.data(), bytes.data() + sizeof header, size);
  return std::all_of(values_.begin(), values_.end(), [](float v) { return std::isfinite(v); });
}

std::shared_ptr<const SignedDistanceField> SignedDistanceField::LoadCached(
    const TriMesh& mesh, const std::filesystem::path& cache_folder) {
  const uint64_t mesh_hash = CalcMeshHash(mesh);
  const auto kept = ReadKept(FindCacheFile(cache_folder, mesh_hash), kCacheKind, mesh_hash);
  auto field = std::make_shared<SignedDistanceField>();
  return kept && field->ParseCache(*kept) ? field : nullptr;
}

std::shared_ptr<const SignedDistanceField> SignedDistanceField::LoadOrBuild(
    const TriMesh& mesh, const std::filesystem::path& cache_folder) {
  if (auto cached = LoadCached(mesh, cache_folder)) return cached;
  auto field = std::make_shared<const SignedDistanceField>(Build(mesh));
  const uint64_t mesh_hash = CalcMeshHash(mesh);
  Keep(FindCacheFile(cache_folder, mesh_hash), kCacheKind, mesh_hash, field->FormatCache());
  return field;
}

SignedDistanceField::Cell SignedDistanceField::FindCell(const Eigen::Vector3d& p_O) const {
  Cell cell;
  const Eigen::Vector3d wanted = (p_O - lower_) / cell_;
  const Eigen::Vector3d highest = (num_nodes_.array() - 1).cast<double>();
  const Eigen::Vector3d clamped = wanted.cwiseMax(0.0).cwiseMin(highest);
  cell.node = clamped.cast<int>().cwiseMin((num_nodes_.array() - 2).matrix());
  cell.share = clamped - cell.node.cast<double>();
  cell.beyond = cell_ * (wanted - clamped).norm();
  return cell;
}

double SignedDistanceField::Interpolate(const Eigen::Vector3i& node,
                                        const Eigen::Vector3d& share) const {
  const int64_t row = num_nodes_.x(), layer = row * num_nodes_.y();
  const float* v = values_.data() + node.x() + row * node.y() + layer * node.z();
  const double x = share.x(), y = share.y(), z = share.z();
  // First along x on the four edges, then along y on the two faces, then along z.
  const double e00 = v[0] + x * (v[1] - v[0]);
  const double e10 = v[row] + x * (v[row + 1] - v[row]);
  const double e01 = v[layer] + x * (v[layer + 1] - v[layer]);
  const double e11 = v[layer + row] + x * (v[layer + row + 1] - v[layer + row]);
  const double f0 = e00 + y * (e10 - e00), f1 = e01 + y * (e11 - e01);
  return f0 + z * (f1 - f0);
}

double SignedDistanceField::CalcDistance(const Cell& cell) const {
  const double distance = Interpolate(cell.node, cell.share);
  // The object lies in the grid's box, so outside it the two parts meet at a right angle or more.
  return cell.beyond > 0.0 ? std::hypot(distance, cell.beyond) : distance;
}

Eigen::Vector3d SignedDistanceField::CalcGradient(const Cell& cell) const {
  // Interpolated central differences of the nodes: the interpolant one cell ahead less that one
  // cell behind.
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3i on = cell.node, back = cell.node;
    on[axis] = std::min(on[axis] + 1, num_nodes_[axis] - 2);
    back[axis] = std::max(back[axis] - 1, 0);
    gradient[axis] = (Interpolate(on, cell.share) - Interpolate(back, cell.share)) /
                     std::max(on[axis] - back[axis], 1);
  }
  // It vanishes on the medial axis only, where the default direction is as good as any.
  const double norm = gradient.norm();
  return norm > 0.0 ? Eigen::Vector3d(gradient / norm) : Sample().gradient;
}

SignedDistanceField::Sample SignedDistanceField::Query(const Eigen::Vector3d& p_O) const {
  const Cell cell = FindCell(p_O);
  return {CalcDistance(cell), CalcGradient(cell)};
}

}  // namespace graspbench
