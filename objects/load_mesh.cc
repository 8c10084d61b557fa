#include "objects/load_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <regex>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/shape/weld_vertices.h"

namespace graspbench {
namespace {

// assimp stores single precision: seven digits of the largest coordinate are noise-free.
constexpr double kRelativeWeldTolerance = 1e-6;

// Parts of the scene hang in a tree of transforms; faces are triangles already.
void AppendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_WParent,
                TriMesh& mesh) {
  const aiMatrix4x4 X_WN = X_WParent * node.mTransformation;
  const bool is_mirrored = X_WN.Determinant() < 0.0f;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    const int first = mesh.num_vertices();
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D p = X_WN * part.mVertices[i];
      mesh.vertices.emplace_back(p.x, p.y, p.z);
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines enclose nothing
      Eigen::Vector3i t;
      for (int k = 0; k < 3; ++k) t[k] = first + static_cast<int>(face.mIndices[k]);
      if (is_mirrored) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    AppendNode(scene, *node.mChildren[c], X_WN, mesh);
  }
}

bool IsFinite(const TriMesh& mesh) {
  for (const Eigen::Vector3d& p : mesh.vertices) {
    if (!p.allFinite()) return false;
  }
  return true;
}

// The text before the data of a PLY file. assimp 5.2 reads for ever in a header that is cut off or
// damaged, so every line must be one that the format knows.
void CheckPlyHeader(const std::string& bytes, const std::string& name) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::kFormat, "mesh \"" + name + "\": " + what +
                                        "; the file is cut off or damaged, export it again from "
                                        "its program");
  };
  static const std::regex kLine(
      "ply|format (ascii|binary_little_endian|binary_big_endian) 1\\.0|(comment|obj_info)[ -~]*|"
      "element \\w+ \\d{1,9}|property (list \\w+ )?\\w+ \\w+|end_header");
  size_t begin = 0;
  for (int line_number = 1;; ++line_number) {
    const size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) fail("its PLY header has no end_header");
    std::string line = bytes.substr(begin, std::min<size_t>(end - begin, 256));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (!std::regex_match(line, kLine)) {
      fail("line " + std::to_string(line_number) + " is not of a PLY header");
    }
    if (line == "end_header") return;
    begin = end + 1;
  }
}

// What assimp does not notice itself.
void CheckBytes(const std::string& bytes, const std::string& name) {
  if (bytes.empty()) {
    throw Error(ErrorKind::kFormat,
                "mesh \"" + name + "\" is empty (0 bytes); export it again from its program");
  }
  static const std::regex kPly("ply", std::regex::icase);
  if (std::regex_match(bytes.substr(0, 3), kPly)) CheckPlyHeader(bytes, name);
}

// The file as read, before polygons are cut into triangles.
void CheckFaces(const aiScene& scene, const std::string& name) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices == 0) {
        // A file cut off within its faces; assimp's triangulation would abort the program.
        throw Error(ErrorKind::kFormat, "mesh \"" + name + "\": face " + std::to_string(i + 1) +
                                            " of " + std::to_string(part.mNumFaces) +
                                            " has no corners; the file may be cut off");
      }
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < part.mNumVertices) continue;
        throw Error(ErrorKind::kFormat, "mesh \"" + name + "\": face " + std::to_string(i + 1) +
                                            " uses vertex " + std::to_string(face.mIndices[k] + 1) +
                                            " of " + std::to_string(part.mNumVertices) +
                                            "; the file may be cut off");
      }
    }
  }
}

TriMesh MakeMesh(Assimp::Importer& importer, const std::string& name, LengthUnit unit) {
  const aiScene* scene = importer.GetScene();
  if (scene) {
    CheckFaces(*scene, name);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (!scene || !scene->mRootNode) {
    throw Error(ErrorKind::kFormat,
                "mesh \"" + name + "\" cannot be read (" + importer.GetErrorString() +
                    "); expected a complete mesh file such as .obj, .stl, .ply or .glb");
  }
  TriMesh mesh;
  AppendNode(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  double largest = 0.0;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p *= MetresPer(unit);
    largest = std::fmax(largest, p.cwiseAbs().maxCoeff());
  }
  if (largest == 0.0 || !IsFinite(mesh)) return mesh;
  return WeldVertices(mesh, kRelativeWeldTolerance * largest);
}

}  // namespace

TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit) {
  CheckBytes(bytes, name);
  const std::string ending = std::filesystem::path(name).extension().string();
  Assimp::Importer importer;
  importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0,
                              ending.empty() ? "" : ending.c_str() + 1);
  return MakeMesh(importer, name, unit);
}

TriMesh LoadMesh(const std::filesystem::path& path, LengthUnit unit) {
  CheckBytes(ReadFile(path), path.string());
  Assimp::Importer importer;
  importer.ReadFile(path.string(), 0);  // by path, so that it finds the parts beside it
  return MakeMesh(importer, path.string(), unit);
}

}  // namespace graspbench
