#include "core/shape/signed_distance_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/shape/primitives.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

// Signed distance of a box with half sizes h; the textbook formula.
double CalcBoxDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& h) {
  const Eigen::Vector3d q = p.cwiseAbs() - h;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

Eigen::Vector3d DrawNode(const SignedDistanceField& field, RandomStream& random) {
  const Eigen::Vector3i n = field.num_nodes();
  return field.lower() + field.cell() * Eigen::Vector3d(random.NextIndex(n.x()),
                                                        random.NextIndex(n.y()),
                                                        random.NextIndex(n.z()));
}

Eigen::Vector3d DrawPoint(const SignedDistanceField& field, RandomStream& random) {
  const Eigen::Vector3d size = field.cell() * (field.num_nodes().array() - 1).cast<double>();
  return field.lower() + Eigen::Vector3d(random.NextUnit(), random.NextUnit(), random.NextUnit())
                             .cwiseProduct(size);
}

TEST(SignedDistanceFieldTest, BoxIsExactAtNodesAndSmoothAwayFromEdges) {
  const Eigen::Vector3d size(0.06, 0.04, 0.03);
  const auto field = SignedDistanceField::Build(MakeRoundedBox(size, 0.0));
  RandomStream random("box", "nodes");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = DrawNode(field, random);
    ASSERT_NEAR(field.Query(p).distance, CalcBoxDistance(p, 0.5 * size), 1e-8) << p.transpose();
  }
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = DrawPoint(field, random);
    const double expected = CalcBoxDistance(p, 0.5 * size);
    ASSERT_NEAR(field.Query(p).distance, expected, 0.5 * field.cell());
    // Curvature 1/d at distance d from an edge, two curved directions at a corner.
    if (expected > 0.004) {
      ASSERT_NEAR(field.Query(p).distance, expected,
                  0.25 * field.cell() * field.cell() / (expected - 2.0 * field.cell()));
    }
  }
}

TEST(SignedDistanceFieldTest, BoxFacesHaveExactNormals) {
  const Eigen::Vector3d size(0.06, 0.04, 0.03);
  const auto field = SignedDistanceField::Build(MakeRoundedBox(size, 0.0));
  const auto above = field.Query({0.01, -0.005, 0.02});
  EXPECT_NEAR(above.distance, 0.005, 1e-8);
  EXPECT_LT((above.gradient - Eigen::Vector3d::UnitZ()).norm(), 1e-4);
  const auto left = field.Query({-0.0371, 0.003, 0.002});
  EXPECT_NEAR(left.distance, 0.0071, 1e-8);
  EXPECT_LT((left.gradient + Eigen::Vector3d::UnitX()).norm(), 1e-4);
}

TEST(SignedDistanceFieldTest, SphereValueAndGradient) {
  const double radius = 0.02;
  const int num_segments = 64;
  const auto field = SignedDistanceField::Build(MakeSphere(radius, num_segments));
  const double sagitta = radius * (1.0 - std::cos(M_PI / num_segments)) * 2.0;
  RandomStream random("sphere", "points");
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = DrawPoint(field, random);
    const double expected = p.norm() - radius;
    const auto sample = field.Query(p);
    if (p.norm() < 0.005) continue;  // next to the centre the field has a kink
    ASSERT_NEAR(sample.distance, expected, sagitta + 0.25 * field.cell() * field.cell() / p.norm());
    ASSERT_GT(sample.gradient.dot(p.normalized()), 0.995);
    ASSERT_NEAR(sample.gradient.norm(), 1.0, 1e-12);
  }
}

TEST(SignedDistanceFieldTest, GradientIsTheInterpolantsOverOneCellEachWay) {
  const auto field =
      SignedDistanceField::Build(MakeTaperedCapsule({0, 0, 0}, 0.02, {0.05, 0, 0}, 0.01));
  RandomStream random("capsule", "points");
  int num_checked = 0;
  while (num_checked < 500) {
    const Eigen::Vector3d p = DrawPoint(field, random);
    // One cell on and one cell back; the distance has no jumps, so the gradient has none.
    const double h = field.cell();
    const Eigen::Array3d in_cell = (p - field.lower()) / h;
    const Eigen::Array3d last = field.num_nodes().cast<double>().array() - 2.0;
    if ((in_cell < 1.0).any() || (in_cell > last).any()) continue;  // next to the grid's border
    Eigen::Vector3d difference;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
      difference[axis] = field.CalcDistance(p + step) - field.CalcDistance(p - step);
    }
    if (difference.norm() < 0.5 * 2.0 * h) continue;  // medial axis
    ASSERT_LT((difference.normalized() - field.Query(p).gradient).norm(), 1e-6);
    ++num_checked;
  }
}

// Distance by every triangle, sign by the winding number: another method altogether.
double CalcDistanceByBruteForce(const TriMesh& mesh, const Eigen::Vector3d& p) {
  double best = INFINITY, winding = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p;
    const Eigen::Vector3d b = mesh.vertices[t[1]] - p;
    const Eigen::Vector3d c = mesh.vertices[t[2]] - p;
    // Van Oosterom and Strackee 1983.
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    winding += 2.0 * std::atan2(a.dot(b.cross(c)),
                                la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    const auto segment = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
      const Eigen::Vector3d d = v - u;
      const double s = std::clamp(-u.dot(d) / d.squaredNorm(), 0.0, 1.0);
      return (u + s * d).norm();
    };
    best = std::min({best, segment(a, b), segment(b, c), segment(c, a)});
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    const Eigen::Vector3d foot = n.dot(a) * n;
    const bool is_within = n.dot((b - a).cross(foot - a)) >= 0.0 &&
                           n.dot((c - b).cross(foot - b)) >= 0.0 &&
                           n.dot((a - c).cross(foot - c)) >= 0.0;
    if (is_within) best = std::min(best, foot.norm());
  }
  return winding > 2.0 * M_PI ? -best : best;
}

// A star-shaped solid with ridges and valleys: convex and concave edges and vertices.
TriMesh MakeBurr() {
  TriMesh mesh = MakeSphere(0.03, 20);
  for (int i = 0; i < mesh.num_vertices(); ++i) mesh.vertices[i] *= i % 2 ? 1.0 : 0.7;
  return mesh;
}

TEST(SignedDistanceFieldTest, NodesEqualBruteForce) {
  const TriMesh mesh = MakeBurr();
  const auto field = SignedDistanceField::Build(mesh);
  RandomStream random("burr", "nodes");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = DrawNode(field, random);
    ASSERT_NEAR(field.Query(p).distance, CalcDistanceByBruteForce(mesh, p), 1e-8) << p.transpose();
  }
}

TEST(SignedDistanceFieldTest, BeyondTheGridItIsALowerBoundThatGrows) {
  const TriMesh mesh = MakeSphere(0.02, 48);
  const auto field = SignedDistanceField::Build(mesh);
  RandomStream random("far", "points");
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
    double previous = 0.0;
    for (const double r : {0.07, 0.1, 0.3, 1.0}) {
      const auto sample = field.Query(r * direction);
      EXPECT_LE(sample.distance, r - 0.02 + 1e-4);
      EXPECT_GT(sample.distance, previous);
      EXPECT_GT(sample.gradient.dot(direction), 0.5);
      previous = sample.distance;
    }
  }
}

TriMesh MakeBoxAt(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  TriMesh box = MakeRoundedBox(size, 0.0);
  for (Eigen::Vector3d& p : box.vertices) p += centre;
  return box;
}

// Two boxes stacked, one running into the other or just touching it, are the box around both.
TEST(SignedDistanceFieldTest, PartsThatOverlapOrTouchAreOneBody) {
  const Eigen::Vector3d whole(0.04, 0.03, 0.05);
  for (const double lower_height : {0.03, 0.02}) {
    const TriMesh mesh =
        JoinMeshes(MakeBoxAt({0.04, 0.03, 0.03}, {0.0, 0.0, 0.01}),
                   MakeBoxAt({0.04, 0.03, lower_height}, {0.0, 0.0, -0.025 + 0.5 * lower_height}));
    const auto field = SignedDistanceField::Build(mesh);
    RandomStream random("union", "nodes");
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d p = DrawNode(field, random);
      const double expected = CalcBoxDistance(p, 0.5 * whole);
      ASSERT_NEAR(field.Query(p).distance, expected, expected > 0.0 ? 1e-8 : field.cell())
          << p.transpose();
    }
  }
}

TEST(SignedDistanceFieldTest, AHollowBodyStaysHollow) {
  TriMesh inner = MakeSphere(0.01, 48);
  for (Eigen::Vector3i& t : inner.triangles) std::swap(t[0], t[1]);
  const auto field = SignedDistanceField::Build(JoinMeshes(MakeSphere(0.02, 48), inner));
  for (const double radius : {0.004, 0.009, 0.0115, 0.015, 0.0185, 0.022, 0.03}) {
    const Eigen::Vector3d p = radius * Eigen::Vector3d(0.36, 0.48, 0.8);
    const double expected = std::max(radius - 0.02, 0.01 - radius);
    EXPECT_NEAR(field.Query(p).distance, expected, 5e-4) << radius;
  }
  // The same shells both facing outwards: no hollow.
  const auto solid =
      SignedDistanceField::Build(JoinMeshes(MakeSphere(0.02, 48), MakeSphere(0.01, 48)));
  EXPECT_NEAR(solid.Query(Eigen::Vector3d(0.0, 0.003, 0.004)).distance, -0.015, 5e-4);
}

class SdfCacheTest : public testing::Test {
 protected:
  SdfCacheTest() {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
  }
  ~SdfCacheTest() override { fs::remove_all(folder_); }
  fs::path OnlyFile() const { return fs::directory_iterator(folder_)->path(); }

  fs::path folder_;
  TriMesh mesh_ = MakeRoundedBox({0.02, 0.02, 0.02}, 0.0);
};

void ExpectSameBits(const SignedDistanceField& a, const SignedDistanceField& b) {
  ASSERT_EQ(a.num_nodes(), b.num_nodes());
  EXPECT_EQ(a.lower(), b.lower());
  EXPECT_EQ(a.cell(), b.cell());
  RandomStream random("cache", "points");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = DrawNode(a, random);
    ASSERT_EQ(a.Query(p).distance, b.Query(p).distance);
  }
}

TEST_F(SdfCacheTest, SecondCallReadsTheSameBits) {
  const auto built = SignedDistanceField::LoadOrBuild(mesh_, folder_);
  const auto stamp = fs::last_write_time(OnlyFile());
  const auto loaded = SignedDistanceField::LoadOrBuild(mesh_, folder_);
  EXPECT_EQ(fs::last_write_time(OnlyFile()), stamp);
  ExpectSameBits(*built, *loaded);
}

TEST_F(SdfCacheTest, DamagedFilesAreRebuilt) {
  const auto built = SignedDistanceField::LoadOrBuild(mesh_, folder_);
  const std::string good = ReadFile(OnlyFile());
  std::string flipped = good;
  flipped[good.size() / 2] ^= 1;
  std::string huge = good;
  const int32_t many = 1 << 30;
  std::memcpy(huge.data() + 56, &many, sizeof many);
  for (const std::string& bad :
       {std::string(), std::string("x"), good.substr(0, 72), good.substr(0, good.size() - 4),
        good + "tail", flipped, huge, std::string(good.size(), '\xff')}) {
    WriteFileAtomically(OnlyFile(), bad);
    ExpectSameBits(*built, *SignedDistanceField::LoadOrBuild(mesh_, folder_));
    EXPECT_EQ(ReadFile(OnlyFile()), good);
  }
}

// A file whose hash is right, as another program's fault or a malicious one would write it.
TEST_F(SdfCacheTest, NumbersThatAreNoneAreRefused) {
  SignedDistanceField::LoadOrBuild(mesh_, folder_);
  const fs::path path = OnlyFile();
  const std::string good = ReadFile(path);
  const auto with = [&](size_t offset, const auto& value) {
    std::string bad = good;
    std::memcpy(bad.data() + offset, &value, sizeof value);
    const uint64_t hash = CalcHash64(std::string_view(bad).substr(16));
    std::memcpy(bad.data() + 8, &hash, sizeof hash);
    return bad;
  };
  constexpr size_t kLower = 24, kCell = 48, kNodes = 56, kValues = 72;
  WriteFile(path, with(kNodes + 12, int32_t{0}));
  ASSERT_NE(SignedDistanceField::LoadCached(mesh_, folder_), nullptr) << "the hash is not right";
  for (const std::string& bad :
       {with(kLower, NAN * 1.0), with(kCell, NAN * 1.0), with(kCell, 0.0), with(kCell, -1.0),
        with(kCell, INFINITY * 1.0), with(kNodes, int32_t{-1}), with(kNodes, int32_t{1}),
        with(kNodes, int32_t{1 << 30}), with(kValues, NAN), with(good.size() - 4, INFINITY)}) {
    WriteFile(path, bad);
    EXPECT_EQ(SignedDistanceField::LoadCached(mesh_, folder_), nullptr);
  }
}

TEST_F(SdfCacheTest, AFolderThatCannotBeWrittenIsDoneWithout) {
  WriteFileAtomically(folder_, "a file where the folder should be");
  EXPECT_NE(SignedDistanceField::LoadOrBuild(mesh_, folder_), nullptr);
}

}  // namespace
}  // namespace graspbench
