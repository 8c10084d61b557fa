// graspbench-mesh-reader: reads one foreign mesh file with assimp, in a process of its own, so that
// a malicious or damaged file can neither crash, stop nor fill the program that asked. One importer
// is registered, no file outside the mesh's folder is opened, and memory and time are limited. See
// mesh_reader_protocol.h.

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOStream.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "objects/mesh_reader_protocol.h"

#ifdef GRASPBENCH_ADDRESS_SANITIZED
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>

extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=1024:soft_rss_limit_mb=1536:handle_abort=1";
}
#endif

namespace graspbench {
namespace {

namespace fs = std::filesystem;

void LimitResources() {
  const auto limit = [](auto resource, rlim_t value) {
    const rlimit soft_and_hard = {value, value + 1};  // a CPU limit is told by its soft one only
    ::setrlimit(resource, &soft_and_hard);
  };
  limit(RLIMIT_CPU, kMeshReaderSeconds);
  limit(RLIMIT_CORE, 0);
#ifndef GRASPBENCH_SANITIZED  // whose shadow memory takes terabytes of addresses
  limit(RLIMIT_AS, kMeshReaderMemory);
#endif
  ::alarm(kMeshReaderWallSeconds);
}

#ifdef GRASPBENCH_ADDRESS_SANITIZED
// Called when a sanitizer ends the process. A lack of memory is the file's fault, as without them.
void EndAsFault() {
  const std::string what = __asan_report_present() != 0 ? __asan_get_report_description() : "";
  for (const char* limit : {"out-of-memory", "allocation-size-too-big", "rss-limit-exceeded"}) {
    if (what == limit) ::_exit(kMeshRefused);
  }
  ::_exit(kMeshFault);
}
#endif

// Regular files in one folder or below it, for reading.
class FolderFiles : public Assimp::DefaultIOSystem {
 public:
  explicit FolderFiles(const std::string& folder) {
    std::error_code status;
    if (!folder.empty()) folder_ = fs::canonical(folder, status);
  }
  bool Exists(const char* file) const override { return !Find(file).empty(); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const std::string path = Find(file);
    if (path.empty() || std::strchr(mode, 'r') == nullptr) return nullptr;
    return Assimp::DefaultIOSystem::Open(path.c_str(), "rb");
  }

 private:
  // Empty: not there, not allowed, or no file. Links are followed first.
  std::string Find(const char* file) const {
    if (folder_.empty()) return {};
    std::error_code status;
    const fs::path path = fs::canonical(folder_ / file, status);
    if (status || !fs::is_regular_file(path, status)) return {};
    const fs::path inside = path.lexically_relative(folder_);
    if (inside.empty() || *inside.begin() == "..") return {};
    return path.string();
  }
  fs::path folder_;
};

void KeepOneImporter(const std::string& format, Assimp::Importer& importer) {
  const std::array<std::pair<const char*, const char*>, 5> kNames = {
      {{"stl", "Stereolithography (STL) Importer"},
       {"ply", "Stanford Polygon Library (PLY) Importer"},
       {"glb", "glTF2 Importer"},
       {"gltf", "glTF2 Importer"},
       {"dae", "Collada Importer"}}};
  std::string name;
  for (const auto& [known, its_name] : kNames) {
    if (format == known) name = its_name;
  }
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (name != importer.GetImporterInfo(i)->mName) {
      importer.UnregisterLoader(importer.GetImporter(i));
    }
  }
  if (importer.GetImporterCount() != 1) throw std::runtime_error("the format is not known");
}

// The file as read, before polygons are cut into triangles, which would abort on these.
void CheckFaces(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      const std::string of =
          "face " + std::to_string(i + 1) + " of " + std::to_string(part.mNumFaces);
      if (face.mNumIndices == 0) throw std::runtime_error(of + " has no corners");
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < part.mNumVertices) continue;
        throw std::runtime_error(of + " uses vertex " + std::to_string(face.mIndices[k] + 1) +
                                 " of " + std::to_string(part.mNumVertices));
      }
    }
  }
}

struct Soup {
  std::vector<double> coordinates;
  std::vector<int32_t> corners;
};

// Parts of the scene hang in a tree of transforms; faces are triangles already.
void AppendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_WParent,
                Soup& soup) {
  const aiMatrix4x4 X_WN = X_WParent * node.mTransformation;
  const bool is_mirrored = X_WN.Determinant() < 0.0f;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    const auto first = static_cast<int32_t>(soup.coordinates.size() / 3);
    if (static_cast<int64_t>(soup.corners.size() / 3) + part.mNumFaces > kMaxMeshTriangles ||
        first + static_cast<int64_t>(part.mNumVertices) > 3 * kMaxMeshTriangles) {
      throw std::runtime_error("it has more than " + std::to_string(kMaxMeshTriangles) +
                               " triangles");
    }
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D p = X_WN * part.mVertices[i];
      soup.coordinates.insert(soup.coordinates.end(), {p.x, p.y, p.z});
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines enclose nothing
      std::array<int32_t, 3> corners;
      for (int k = 0; k < 3; ++k) corners[k] = first + static_cast<int32_t>(face.mIndices[k]);
      if (is_mirrored) std::swap(corners[1], corners[2]);
      soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    AppendNode(scene, *node.mChildren[c], X_WN, soup);
  }
}

std::string ReadInput() {
  struct stat properties = {};
  if (::fstat(STDIN_FILENO, &properties) != 0) throw std::runtime_error("no input");
  std::string bytes(static_cast<size_t>(properties.st_size), '\0');
  for (size_t size = 0; size < bytes.size();) {
    const ssize_t count = ::read(STDIN_FILENO, bytes.data() + size, bytes.size() - size);
    if (count <= 0) throw std::runtime_error("the input is cut off");
    size += static_cast<size_t>(count);
  }
  return bytes;
}

Soup ReadMesh(const std::string& format, const std::string& folder) {
  const std::string bytes = ReadInput();
  Assimp::Importer importer;
  KeepOneImporter(format, importer);
  // The axes of a robot's pictures are those of its links, whatever the file says is up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetIOHandler(new FolderFiles(folder));  // the importer's own from here
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
  if (scene) {
    CheckFaces(*scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (!scene || !scene->mRootNode) {
    std::string fault = importer.GetErrorString();
    const size_t name = fault.find(" for $$$___magic___$$$");  // of bytes in memory
    if (name != fault.npos) fault.resize(name);
    if (fault.find("bad_alloc") != fault.npos) throw std::bad_alloc();
    throw std::runtime_error(fault);
  }
  Soup soup;
  AppendNode(*scene, *scene->mRootNode, aiMatrix4x4(), soup);
  return soup;
}

void WriteOutput(const void* data, size_t size) {
  if (std::fwrite(data, 1, size, stdout) != size) throw std::runtime_error("cannot write");
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  using namespace graspbench;
  LimitResources();
#ifdef GRASPBENCH_ADDRESS_SANITIZED
  __sanitizer_set_death_callback(&EndAsFault);
#endif
  if (argc != 3) return kMeshRefused;
  try {
    const Soup soup = ReadMesh(argv[1], argv[2]);
    const MeshReaderHead head = {static_cast<int64_t>(soup.coordinates.size() / 3),
                                 static_cast<int64_t>(soup.corners.size() / 3)};
    WriteOutput(&head, sizeof head);
    WriteOutput(soup.coordinates.data(), soup.coordinates.size() * sizeof(double));
    WriteOutput(soup.corners.data(), soup.corners.size() * sizeof(int32_t));
    if (std::fflush(stdout) != 0) return kMeshRefused;
    ::_exit(kMeshRead);  // the process goes, and its memory with it
  } catch (const std::bad_alloc&) {
    std::fputs("it needs too much memory", stdout);
  } catch (const std::exception& fault) {
    std::fputs(fault.what(), stdout);
  }
  std::fflush(stdout);
  ::_exit(kMeshRefused);
}
