#include "objects/load_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/shape/mass_properties.h"
#include "core/shape/mesh_check.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

TriMesh MakeBox() { return MakeRoundedBox({0.04, 0.03, 0.02}, 0.0); }

// As written by most programs: binary, every triangle with corners of its own.
std::string FormatBinaryStl(const TriMesh& mesh) {
  std::string bytes(80, ' ');
  const auto append = [&](const void* data, size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const uint32_t count = static_cast<uint32_t>(mesh.num_triangles());
  append(&count, 4);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    append(normal.data(), 12);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f p = mesh.vertices[t[k]].cast<float>();
      append(p.data(), 12);
    }
    append("\0\0", 2);
  }
  return bytes;
}

std::string FindMessage(const std::string& bytes, const std::string& name) {
  try {
    ParseMesh(bytes, name, LengthUnit::kM);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    return e.what();
  }
  return "no error";
}

TEST(LoadMeshTest, WrittenAndReadBackItIsTheSameSolid) {
  const TriMesh ball = MakeSphere(0.02, 24);
  for (const LengthUnit unit : {LengthUnit::kM, LengthUnit::kMm}) {
    const TriMesh read = ParseMesh(FormatObj(ball, UnitsPerMetre(unit)), "ball.obj", unit);
    EXPECT_EQ(read.num_vertices(), ball.num_vertices());
    EXPECT_EQ(read.num_triangles(), ball.num_triangles());
    // Written in metres, a coordinate is rounded to 1 um of 20 mm.
    EXPECT_NEAR(CalcVolume(read), CalcVolume(ball), 1e-4 * CalcVolume(ball));
    EXPECT_EQ(FormatProblems(CheckMesh(read)), "");
  }
}

TEST(LoadMeshTest, StlCornersAreWelded) {
  const TriMesh ball = MakeSphere(0.02, 24);
  const TriMesh read = ParseMesh(FormatBinaryStl(ball), "ball.stl", LengthUnit::kM);
  EXPECT_EQ(read.num_vertices(), ball.num_vertices());
  EXPECT_EQ(FormatProblems(CheckMesh(read)), "");
}

TEST(LoadMeshTest, QuadsAndSeveralPartsBecomeOneTriangleMesh) {
  std::string text;
  int first = 1;
  for (const double x : {0.0, 0.05}) {
    for (const double z : {0.0, 0.02}) {
      for (const auto& [dx, y] : {std::pair(0.0, 0.0), {0.03, 0.0}, {0.03, 0.04}, {0.0, 0.04}}) {
        text += "v " + std::to_string(x + dx) + " " + std::to_string(y) + " " + std::to_string(z) +
                "\n";
      }
    }
    text += "o part" + std::to_string(first) + "\n";
    for (const std::array<int, 4>& quad : {std::array<int, 4>{0, 3, 2, 1},
                                           {4, 5, 6, 7},
                                           {0, 1, 5, 4},
                                           {1, 2, 6, 5},
                                           {2, 3, 7, 6},
                                           {3, 0, 4, 7}}) {
      text += "f";
      for (const int corner : quad) text += " " + std::to_string(first + corner);
      text += "\n";
    }
    first += 8;
  }
  const TriMesh mesh = ParseMesh(text, "parts.obj", LengthUnit::kM);
  EXPECT_EQ(mesh.num_triangles(), 24);
  EXPECT_EQ(FormatProblems(CheckMesh(mesh)), "");
  EXPECT_NEAR(CalcVolume(mesh), 2.0 * 0.03 * 0.04 * 0.02, 1e-9);
}

TEST(LoadMeshTest, FilesThatAreNoMeshesAreRefused) {
  EXPECT_EQ(FindMessage("", "a.stl"),
            "mesh \"a.stl\" is empty (0 bytes); export it again from its program");
  const std::string stl = FormatBinaryStl(MakeBox());
  for (const std::string& bytes :
       {stl.substr(0, stl.size() / 2), stl.substr(0, 83), stl.substr(0, 10)}) {
    const std::string message = FindMessage(bytes, "cut.stl");
    EXPECT_EQ(message.find("mesh \"cut.stl\" cannot be read ("), 0u) << message;
    EXPECT_NE(message.find("expected a complete mesh file such as .obj, .stl, .ply or .glb"),
              std::string::npos);
  }
  EXPECT_EQ(FindMessage("ply\nformat ascii 1.0\nelement vert", "cut.ply"),
            "mesh \"cut.ply\": its PLY header has no end_header; the file is cut off or damaged, "
            "export it again from its program");
  EXPECT_EQ(FindMessage("ply\nformat ascii 1.0\nelem\1ent vertex 3\nend_header\n", "bad.ply"),
            "mesh \"bad.ply\": line 3 is not of a PLY header; the file is cut off or damaged, "
            "export it again from its program");
  EXPECT_EQ(FindMessage("hello", "notes.txt").find("mesh \"notes.txt\" cannot be read ("), 0u);
}

TEST(LoadMeshTest, RandomBytesNeverCrash) {
  RandomStream random("mesh", "bytes");
  const std::string good[] = {FormatObj(MakeBox(), 1e3), FormatBinaryStl(MakeBox())};
  const char* names[] = {"x.obj", "x.stl"};
  for (int i = 0; i < 200; ++i) {
    std::string bytes = good[i % 2];
    for (int k = 0; k < 1 + i % 20; ++k) {
      bytes[random.NextIndex(static_cast<int>(bytes.size()))] =
          static_cast<char>(random.NextIndex(256));
    }
    try {
      CheckMesh(ParseMesh(bytes, names[i % 2], LengthUnit::kMm));
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    }
  }
}

TEST(LoadMeshTest, NotANumberReachesTheCheck) {
  std::string stl = FormatBinaryStl(MakeBox());
  const float nan = NAN;
  std::memcpy(stl.data() + 84 + 12, &nan, sizeof nan);
  const TriMesh mesh = ParseMesh(stl, "nan.stl", LengthUnit::kM);
  ASSERT_EQ(CheckMesh(mesh).problems.size(), 1u);
  EXPECT_EQ(CheckMesh(mesh).problems[0].fault, MeshFault::kNotFinite);
}

}  // namespace
}  // namespace graspbench
