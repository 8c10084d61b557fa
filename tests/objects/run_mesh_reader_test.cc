#include "objects/run_mesh_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace graspbench {
namespace {

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
    EXPECT_EQ(message.find("mesh \"the file\" cannot be read ("), 0u) << message;
    for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
  }
}

TEST(RunMeshReaderTest, OneFormatIsReadAsAskedForAndNoOther) {
  EXPECT_NE(FindReaderMessage(kAsciiStl, "ply"), "no error");
  EXPECT_NE(FindReaderMessage("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "off")
                .find("(the format is not known)"),
            std::string::npos);
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
