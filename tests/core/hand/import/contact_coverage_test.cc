// How well what an imported hand touches with covers what its description has, and whether digit and
// palm touch where the description's own solids are apart: measured against the description's
// surfaces by winding numbers and brute force, which share nothing with the fit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <random>

#include "core/base/units.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/shape/primitives.h"
#include "tests/core/hand/import/import_file.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;
using Eigen::Vector3d;

/** How often the mesh winds around p: van Oosterom and Strackee 1983. */
double CalcWinding(const TriMesh& mesh, const Vector3d& p) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                   c = mesh.vertices[t[2]] - p;
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
  }
  return sum / (2.0 * kPi);
}

struct Solids {
  std::vector<TriMesh> meshes;
  std::vector<Vector3d> surface;  // points of the outside of all of them together

  bool Contains(const Vector3d& p) const {
    for (const TriMesh& mesh : meshes) {
      if (CalcWinding(mesh, p) > 0.5) return true;
    }
    return false;
  }
};

constexpr int kPoints = 1500;

void SampleSurface(Solids& solids) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> areas;
  std::vector<std::array<Vector3d, 3>> corners;
  for (const TriMesh& mesh : solids.meshes) {
    for (const Eigen::Vector3i& t : mesh.triangles) {
      corners.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
      const auto& [a, b, c] = corners.back();
      areas.push_back((b - a).cross(c - a).norm());
    }
  }
  std::discrete_distribution<size_t> choose(areas.begin(), areas.end());
  for (int n = 0; n < kPoints; ++n) {
    const auto& [a, b, c] = corners[choose(random)];
    double u = uniform(random), v = uniform(random);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d p = a + u * (b - a) + v * (c - a);
    const Vector3d out = (b - a).cross(c - a).normalized();
    if (!solids.Contains(p + 1e-4 * out)) solids.surface.push_back(p);
  }
}

TriMesh MakeMesh(const ForeignShape& shape, const fs::path& folder) {
  TriMesh mesh;
  if (shape.kind == ForeignShape::Kind::kMesh) {
    Diagnostics unread;
    mesh = ParseObj(ReadFile(folder / shape.mesh), shape.mesh, unread);
    for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(shape.scale);
  } else if (shape.kind == ForeignShape::Kind::kBox) {
    mesh = MakeRoundedBox(shape.size, 0.0);
  } else if (shape.kind == ForeignShape::Kind::kSphere) {
    mesh = MakeSphere(0.5 * shape.size.x());
  } else {
    const double r = 0.5 * shape.size.x(), h = 0.5 * shape.size.z();
    mesh = MakeRevolution({{0.0, -h}, {r, -h}, {r, h}, {0.0, h}});
  }
  for (Vector3d& p : mesh.vertices) p = shape.X_LS * p;
  return mesh;
}

struct Imported {
  Hand hand;
  std::map<int, Solids> solids;  // of the description, by link of the hand
};

Imported ImportAndLoad(const fs::path& file) {
  Diagnostics problems;
  const ImportedFiles files = ImportHand(ReadFile(file), MakeFileSource(file, true), "", problems);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  Imported imported;
  imported.hand = WriteAndLoad(files);

  Diagnostics unread;
  const ForeignHand foreign = ReadForeignUrdf(ReadFile(file), file.string(), unread);
  for (const ForeignLink& link : foreign.links) {
    int index = imported.hand.FindLink(link.name);
    Pose X_LF = Pose::Identity();
    for (const NamedFrame& frame : imported.hand.frames) {
      if (frame.name != link.name) continue;
      index = frame.link;
      X_LF = frame.X_LF;
    }
    for (const ForeignShape& shape : link.collisions) {
      TriMesh mesh = MakeMesh(shape, file.parent_path());
      for (Vector3d& p : mesh.vertices) p = X_LF * p;
      imported.solids[index].meshes.push_back(mesh);
    }
  }
  for (auto& [index, solids] : imported.solids) SampleSurface(solids);
  return imported;
}

/** What 95 of 100 points of the surface are not farther outside the link's balls than. */
double CalcUncovered(const Hand& hand, int link, const std::vector<Vector3d>& points) {
  std::vector<double> gaps;
  for (const Vector3d& p : points) {
    double least = 1.0;
    for (const ContactSphere& ball : hand.contact_spheres) {
      if (ball.link == link) least = std::min(least, (p - ball.p_LS).norm() - ball.radius);
    }
    gaps.push_back(least);
  }
  const auto at = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() * 19 / 20);
  std::nth_element(gaps.begin(), at, gaps.end());
  return *at;
}

class ContactCoverageTest : public testing::TestWithParam<const char*> {};

TEST_P(ContactCoverageTest, EveryLinkOfADigitIsCovered) {
  const fs::path file = FindDescription(GetParam());
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  const Imported imported = ImportAndLoad(file);
  double largest = 0.0;
  for (const auto& [link, solids] : imported.solids) {
    const double uncovered = CalcUncovered(imported.hand, link, solids.surface);
    if (imported.hand.FindDigitOfLink(link) < 0) continue;
    largest = std::max(largest, uncovered);
    EXPECT_LE(MmFromM(uncovered), 1.5) << imported.hand.links[link].name;
  }
  EXPECT_GT(largest, 0.0);
  RecordProperty("most_uncovered_mm", std::to_string(MmFromM(largest)));
  RecordProperty("balls", static_cast<int>(imported.hand.contact_spheres.size()));
}

/** 0 when a part of the one lies in the other. */
double CalcApart(const Solids& digit, const Solids& palm, const Pose& X_PD) {
  double least = 1.0;
  for (const Vector3d& p : digit.surface) {
    if (palm.Contains(X_PD * p)) return 0.0;
    for (const Vector3d& s : palm.surface) least = std::min(least, (X_PD * p - s).norm());
  }
  return least;
}

// The points of either surface are some 3 mm apart, so a touch is found within about half of that.
TEST_P(ContactCoverageTest, DigitAndPalmMeetOnlyWhereTheirSolidsDo) {
  const fs::path file = FindDescription(GetParam());
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  const Imported imported = ImportAndLoad(file);
  const Hand& hand = imported.hand;
  const Solids& palm = imported.solids.at(hand.palm_link);
  const std::vector<CapsulePair> pairs = FindCapsulePairs(hand);
  std::mt19937 random(3);
  int num_contacts = 0;
  for (int posture = 0; posture < 200; ++posture) {
    Eigen::VectorXd q(hand.num_joints());
    for (int j = 0; j < hand.num_joints(); ++j) {
      const HandJoint& joint = hand.joints[j];
      q[j] = std::uniform_real_distribution<double>(joint.lower, joint.upper)(random);
    }
    ApplyCoupling(hand, q);
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
    std::map<int, double> depths;  // by link of a digit
    for (const CapsulePair& pair : pairs) {
      int a = hand.capsules[pair.a].link, b = hand.capsules[pair.b].link;
      if (b == hand.palm_link) std::swap(a, b);
      if (a != hand.palm_link || hand.FindDigitOfLink(b) < 0) continue;
      depths[b] = std::max(depths[b], -CalcCapsuleGap(hand, pair, X_HL));
    }
    for (const auto& [link, depth] : depths) {
      if (depth <= 0.0005) continue;
      ++num_contacts;
      const Pose X_PL = X_HL[hand.palm_link].inverse() * X_HL[link];
      EXPECT_LE(CalcApart(imported.solids.at(link), palm, X_PL), 0.003)
          << hand.links[link].name << " is " << MmFromM(depth) << " mm in the palm";
    }
  }
  RecordProperty("contacts", num_contacts);
}

INSTANTIATE_TEST_SUITE_P(Hands, ContactCoverageTest,
                         testing::Values("claw_meshes.urdf", "five_digits.urdf",
                                         "adaptive_three.urdf", "servo_four.urdf",
                                         "six_drives.urdf", "nine_drives.urdf",
                                         "allegro_hand/allegro_hand_right.urdf",
                                         "barrett_hand/bhand_model.urdf"));

}  // namespace
}  // namespace graspbench
