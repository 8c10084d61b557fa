#include "objects/load_mesh.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"
#include "tests/support/shared_data.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

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

TEST(LoadMeshTest, StlWithTrailingBytesOrInCapitalsIsRead) {
  const TriMesh box = MakeBox();
  const TriMesh trailed =
      ParseMesh(FormatBinaryStl(box) + std::string(37, '\0'), "b.stl", LengthUnit::kM);
  EXPECT_NEAR(CalcVolume(trailed), CalcVolume(box), 1e-6 * CalcVolume(box));
  std::ostringstream text;
  text << "SOLID box\n";
  for (const Eigen::Vector3i& t : box.triangles) {
    text << "FACET NORMAL 0 0 0\nOUTER LOOP\n" << std::uppercase << std::scientific;
    for (int k = 0; k < 3; ++k) text << "VERTEX " << box.vertices[t[k]].transpose() << "\n";
    text << "ENDLOOP\nENDFACET\n";
  }
  text << "ENDSOLID box\n";
  const TriMesh capitals = ParseMesh(text.str(), "b.STL", LengthUnit::kM);
  EXPECT_NEAR(CalcVolume(capitals), CalcVolume(box), 1e-5 * CalcVolume(box));
}

// Blocks of 30 x 40 x 50 mm that others have written, in capitals and with bytes behind the end.
TEST(LoadMeshTest, StrangersStlIsReadAndQuantizedGltfNamed) {
  const fs::path folder = FindSharedData() / "strangers" / "hands";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not on this machine";
  for (const char* name : {"ascii_upper.stl", "trail.stl"}) {
    const TriMesh block = ParseMesh(ReadFile(folder / name), name, LengthUnit::kM);
    EXPECT_NEAR(CalcVolume(block), 0.03 * 0.04 * 0.05, 1e-10) << name;
    EXPECT_EQ(FormatProblems(CheckMesh(block)), "") << name;
  }
  EXPECT_EQ(FindMessage(ReadFile(folder / "quant.gltf"), "quant.gltf"),
            "mesh \"quant.gltf\" requires the glTF extension KHR_mesh_quantization, which is not "
            "read; export it without");
}

TEST(LoadMeshTest, WhatIsNoMeshOrNeedsAnExtensionIsNamed) {
  EXPECT_EQ(FindMessage("version https://git-lfs.github.com/spec/v1\noid sha256:1\n", "a.obj"),
            "mesh \"a.obj\" is a Git LFS pointer, not the mesh itself; get it with: git lfs pull");
  EXPECT_EQ(FindMessage(R"({"extensionsRequired": ["KHR_mesh_quantization"]})", "q.gltf"),
            "mesh \"q.gltf\" requires the glTF extension KHR_mesh_quantization, which is not read; "
            "export it without");
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
  EXPECT_NE(FormatProblems(CheckMesh(mesh)).find("1 part with 50 % of the volume"),
            std::string::npos);  // two boxes side by side are no rigid body
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
    EXPECT_NE(message.find("the file may be cut off or damaged"), std::string::npos);
    EXPECT_EQ(message.find("magic"), std::string::npos) << message;
  }
  EXPECT_EQ(FindMessage("ply\nformat ascii 1.0\nelement vert", "cut.ply"),
            "mesh \"cut.ply\": its PLY header has no end_header; the file is cut off or damaged, "
            "export it again from its program");
  EXPECT_EQ(FindMessage("ply\nformat ascii 1.0\nelem\1ent vertex 3\nend_header\n", "bad.ply"),
            "mesh \"bad.ply\": line 3 is not of a PLY header, or says more than 999999999 of "
            "something; the file is cut off or damaged, export it again from its program");
  const std::string far =
      FindMessage("v 1e9 0 0\nv 1e9 0.01 0\nv 1e9 0 0.01\nf 1 2 3\n", "far.obj");
  EXPECT_EQ(far.find("mesh \"far.obj\" lies up to 1e+09 m from its origin"), 0u) << far;
  EXPECT_EQ(FindMessage("v 0 0 0\nf 1 2 3\n", "a.obj"),
            "the mesh cannot be read\na.obj:2: error: expected three or more numbers of vertices "
            "above after f");
}

// A scan of which the download stopped: assimp would read for ever.
TEST(LoadMeshTest, AnAsciiPlyThatIsCutOffIsTold) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n.1 0 0\n0 .1 "
      "0\n0 0 .1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3";
  EXPECT_NEAR(CalcVolume(ParseMesh(ply, "a.ply", LengthUnit::kM)), 1e-3 / 6.0, 1e-9);
  EXPECT_NEAR(CalcVolume(ParseMesh(ply + "\n", "a.PLY", LengthUnit::kM)), 1e-3 / 6.0, 1e-9);
  ply.resize(ply.size() - 8);
  EXPECT_EQ(FindMessage(ply, "a.ply"),
            "mesh \"a.ply\": it has 7 of 8 lines after its PLY header; the file is cut off or "
            "damaged, export it again from its program");
}

TEST(LoadMeshTest, OtherFormatsAreRefusedByName) {
  const std::string advice = "; export it as OBJ, STL, PLY, GLB or glTF";
  EXPECT_EQ(FindMessage("x", "a.3ds"),
            "mesh \"a.3ds\": 3DS is not read, its axes are not certain" + advice);
  EXPECT_EQ(FindMessage("x", "a.DXF"),
            "mesh \"a.DXF\": DXF is not read, its axes are not certain" + advice);
  EXPECT_EQ(FindMessage("x", "a.dae"),
            "mesh \"a.dae\": COLLADA is not read, its reader is not safe" + advice);
  EXPECT_EQ(FindMessage("x", "a.off"), "mesh \"a.off\": OFF is not read" + advice);
  EXPECT_EQ(FindMessage("x", "a.stl.zip"), "mesh \"a.stl.zip\": ZIP is not read" + advice);
  EXPECT_EQ(FindMessage("x", "a.3mf"), "mesh \"a.3mf\": 3MF is not read" + advice);
  for (const char* name : {"a.assbin", "mesh", "a.x-y", "a."}) {
    EXPECT_EQ(FindMessage("x", name), "mesh \"" + std::string(name) +
                                          "\" has an ending that names no known format" + advice);
  }
  // The content does not choose: an OFF file in an STL's clothes is no STL.
  EXPECT_NE(FindMessage("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.stl"), "no error");
}

// 100,000 corners: in a second as a convex polygon, refused in less when it is not.
TEST(LoadMeshTest, APictureMayBeCollada) {
  const std::string file = std::string(testing::TempDir()) + "/picture.dae";
  const std::string text = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 20 0 0 0 30 0 0 0 40</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s"><node id="n" name="n">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  WriteFile(file, text);
  const TriMesh mesh = LoadPictureMesh(file);
  // In its own unit, and z stays z.
  EXPECT_NEAR(CalcVolume(mesh), 0.02 * 0.03 * 0.04 / 6.0, 1e-11);
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : mesh.vertices) corner = corner.cwiseMax(p);
  EXPECT_LT((corner - Eigen::Vector3d(0.02, 0.03, 0.04)).norm(), 1e-8);
  // Damaged, it is an error and nothing worse.
  for (size_t size = 100; size < text.size(); size += 100) {
    WriteFile(file, text.substr(0, size));
    EXPECT_THROW(LoadPictureMesh(file), Error) << size;
  }
  std::filesystem::remove(file);
}

TEST(LoadMeshTest, APolygonOfManyCornersIsNoTrap) {
  for (const bool is_convex : {true, false}) {
    std::string text, face = "f";
    for (int i = 0; i < 100'000; ++i) {
      const double angle = 2.0 * kPi * i / 100'000, radius = is_convex || i % 2 ? 50.0 : 40.0;
      text += "v " + std::to_string(radius * std::cos(angle)) + " " +
              std::to_string(radius * std::sin(angle)) + " 0\n";
      face += " " + std::to_string(i + 1);
    }
    const std::clock_t start = std::clock();
    const std::string message = FindMessage(text + face + "\n", "disc.obj");
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1.0) << is_convex;
    EXPECT_EQ(message, is_convex
                           ? "no error"
                           : "the mesh cannot be read\ndisc.obj:100001: error: the face has "
                             "100000 corners and is not convex; cut such faces into triangles "
                             "in the program that made the mesh");
  }
}

// A box as glTF with its numbers in a file beside it.
class GltfTest : public testing::Test {
 protected:
  GltfTest() {
    fs::remove_all(root_);
    fs::create_directories(folder_ / "parts");
    std::string numbers;
    const TriMesh box = MakeBox();
    for (const Eigen::Vector3d& p : box.vertices) {
      const Eigen::Vector3f single = p.cast<float>();
      numbers.append(reinterpret_cast<const char*>(single.data()), 12);
    }
    for (const Eigen::Vector3i& t : box.triangles) {
      for (int k = 0; k < 3; ++k) {
        const auto corner = static_cast<uint16_t>(t[k]);
        numbers.append(reinterpret_cast<const char*>(&corner), 2);
      }
    }
    for (const fs::path& place :
         {folder_ / "box.bin", folder_ / "parts" / "box.bin", root_ / "secret.bin"}) {
      WriteFile(place, numbers);
    }
    num_vertices_ = box.num_vertices();
    num_triangles_ = box.num_triangles();
  }
  ~GltfTest() override { fs::remove_all(root_); }

  // "no error", or the message.
  std::string Read(const std::string& uri) {
    const std::string vertices = std::to_string(num_vertices_);
    const std::string corners = std::to_string(3 * num_triangles_);
    const std::string vertex_bytes = std::to_string(12 * num_vertices_);
    const std::string corner_bytes = std::to_string(6 * num_triangles_);
    const std::string bytes = std::to_string(12 * num_vertices_ + 6 * num_triangles_);
    WriteFile(
        folder_ / "box.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
            vertices + R"(,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},)" +
            R"({"bufferView":1,"componentType":5123,"count":)" + corners +
            R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
            vertex_bytes + R"(},{"buffer":0,"byteOffset":)" + vertex_bytes + R"(,"byteLength":)" +
            corner_bytes + R"(}],"buffers":[{"uri":")" + uri + R"(","byteLength":)" + bytes +
            "}]}");
    try {
      mesh_ = LoadMesh(folder_ / "box.gltf", LengthUnit::kM);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kFormat);
      return e.what();
    }
    return "no error";
  }

  // Of this test alone: others of this file run at the same time.
  const fs::path root_ =
      fs::path(testing::TempDir()) /
      (std::string("gltf_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path folder_ = root_ / "mesh";
  int num_vertices_ = 0, num_triangles_ = 0;
  TriMesh mesh_;
};

TEST_F(GltfTest, ReadsItsPartsFromItsOwnFolderOnly) {
  for (const char* uri : {"box.bin", "parts/box.bin", "parts/../box.bin"}) {
    ASSERT_EQ(Read(uri), "no error") << uri;
    EXPECT_EQ(FormatProblems(CheckMesh(mesh_)), "");
    EXPECT_NEAR(CalcVolume(mesh_), 0.04 * 0.03 * 0.02, 1e-9);
  }
  fs::create_symlink(root_ / "secret.bin", folder_ / "link.bin");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.bin").c_str(), 0600), 0);
  for (const std::string& uri :
       {std::string("../secret.bin"), (root_ / "secret.bin").string(), std::string("link.bin"),
        std::string("parts/../../secret.bin"), std::string("pipe.bin"), std::string("/dev/zero"),
        std::string("none.bin"), std::string("parts")}) {
    EXPECT_EQ(Read(uri).find("mesh \"" + (folder_ / "box.gltf").string() + "\" cannot be read ("),
              0u)
        << uri;
  }
}

// Who opened a material library that is a pipe would wait for ever.
TEST_F(GltfTest, AMaterialLibraryIsNotOpened) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.mtl").c_str(), 0600), 0);
  WriteFile(folder_ / "box.obj", "mtllib pipe.mtl\n" + FormatObj(MakeBox()));
  EXPECT_EQ(LoadMesh(folder_ / "box.obj", LengthUnit::kM).num_triangles(), num_triangles_);
}

TEST_F(GltfTest, PipesDevicesAndFoldersAreNoMeshes) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.stl").c_str(), 0600), 0);
  fs::create_directory(folder_ / "folder.obj");
  fs::create_symlink("/dev/zero", folder_ / "zero.ply");
  for (const char* name : {"pipe.stl", "folder.obj", "zero.ply"}) {
    try {
      LoadMesh(folder_ / name, LengthUnit::kM);
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kIo);
    }
  }
}

TEST(LoadMeshTest, RandomBytesNeverCrash) {
  RandomStream random("mesh", "bytes");
  const std::string good[] = {FormatObj(MakeBox(), 1e3), FormatBinaryStl(MakeBox())};
  const char* names[] = {"x.obj", "x.stl"};
  for (int i = 0; i < 100; ++i) {
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

const char kAsciiStl[] =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 5 6\nvertex 7 8 10\nendloop\n"
    "endfacet\nendsolid a\n";

std::string FindReaderMessage(const std::string& bytes, const std::string& format) {
  try {
    RunMeshReader(bytes, format, {}, "the file");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    return e.what();
  }
  return "no error";
}

TEST(RunMeshReaderTest, HandsOverWhatTheFileHolds) {
  const TriMesh mesh = RunMeshReader(kAsciiStl, "stl", {}, "a.stl");
  ASSERT_EQ(mesh.num_triangles(), 1);
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][0]], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][2]], Eigen::Vector3d(7, 8, 10));
}

TEST(RunMeshReaderTest, ThreadsDoNotMeet) {
  std::vector<int> num_read(4, 0);
  std::vector<std::thread> threads;
  for (int& count : num_read) {
    threads.emplace_back([&count] {
      for (int i = 0; i < 5; ++i) count += RunMeshReader(kAsciiStl, "stl", {}, "a").num_triangles();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(num_read, std::vector<int>(4, 5));
}

TEST(RunMeshReaderTest, MessagesArePrintable) {
  const std::string escape = "\x1b]0;title\x07\xe2\x80\xae";
  for (const std::string format : {"gltf", "ply", "stl", "glb"}) {
    const std::string message = FindReaderMessage("{\"" + escape + "\": [" + escape, format);
    EXPECT_EQ(message.find("mesh \"the file\""), 0u) << message;
    for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
  }
}

TEST(RunMeshReaderTest, AFileThatAsksForTooMuchIsRefused) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 999999999\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
      "0\n0 1 0\n3 0 1";
  EXPECT_NE(FindReaderMessage(ply, "ply"), "no error");
}

}  // namespace
}  // namespace graspbench
