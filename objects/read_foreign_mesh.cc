#include "objects/read_foreign_mesh.h"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <new>
#include <regex>
#include <stdexcept>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "objects/mesh_limits.h"

namespace graspbench {
namespace {

// Files beside the mesh, each read once.
class FilesBeside : public Assimp::IOSystem {
 public:
  explicit FilesBeside(const ReadBeside& read) : read_(read) {}
  bool Exists(const char* file) const override { return Find(file) != nullptr; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    const std::string* const content = Find(file);
    if (content == nullptr) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(content->data()),
                                      content->size());
  }
  void Close(Assimp::IOStream* file) override { delete file; }

 private:
  const std::string* Find(const std::string& name) const {
    auto found = contents_.find(name);
    if (found == contents_.end()) found = contents_.emplace(name, read_(name)).first;
    return found->second ? &*found->second : nullptr;
  }
  const ReadBeside& read_;
  mutable std::map<std::string, std::optional<std::string>> contents_;
};

constexpr size_t kMaxMessage = 200;

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

// Parts of the scene hang in a tree of transforms; faces are triangles already.
void AppendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_WParent,
                TriMesh& soup) {
  const aiMatrix4x4 X_WN = X_WParent * node.mTransformation;
  const bool is_mirrored = X_WN.Determinant() < 0.0f;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    const int first = soup.num_vertices();
    if (static_cast<int64_t>(soup.num_triangles()) + part.mNumFaces > kMaxMeshTriangles ||
        first + static_cast<int64_t>(part.mNumVertices) > 3 * kMaxMeshTriangles) {
      throw std::runtime_error("it has more than " + std::to_string(kMaxMeshTriangles) +
                               " triangles");
    }
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D p = X_WN * part.mVertices[i];
      soup.vertices.emplace_back(p.x, p.y, p.z);
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines enclose nothing
      Eigen::Vector3i corners;
      for (int k = 0; k < 3; ++k) corners[k] = first + static_cast<int>(face.mIndices[k]);
      if (is_mirrored) std::swap(corners[1], corners[2]);
      soup.triangles.push_back(corners);
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    AppendNode(scene, *node.mChildren[c], X_WN, soup);
  }
}

TriMesh ReadWithAssimp(const std::string& bytes, const std::string& format,
                       const ReadBeside& read_beside) {
  Assimp::Importer importer;
  KeepOneImporter(format, importer);
  // The axes of a robot's pictures are those of its links, whatever the file says is up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetIOHandler(new FilesBeside(read_beside));  // the importer's own from here
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
  TriMesh soup;
  AppendNode(*scene, *scene->mRootNode, aiMatrix4x4(), soup);
  return soup;
}

// assimp's own words are partly the file's: nothing but printable characters reaches a terminal.
std::string MakePrintable(std::string text) {
  if (text.size() > kMaxMessage) text.resize(kMaxMessage);
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

// The nearest number of single precision, whole and fractional part each: the catalogue's recorded
// results stand on coordinates read so.
double RoundToSingle(double value) {
  const double whole = std::trunc(value);
  return static_cast<float>(whole) + static_cast<float>(value - whole);
}

TriMesh ReadObj(const std::string& bytes, const std::string& name) {
  Diagnostics problems;
  TriMesh mesh = ParseObj(bytes, name, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the mesh cannot be read");
  if (mesh.num_triangles() > kMaxMeshTriangles) {
    throw Error(ErrorKind::kFormat, "mesh \"" + name + "\" has more than " +
                                        std::to_string(kMaxMeshTriangles) +
                                        " triangles; simplify it");
  }
  for (Eigen::Vector3d& p : mesh.vertices) p = p.unaryExpr(&RoundToSingle);
  return mesh;
}

[[noreturn]] void FailDamaged(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::kFormat, "mesh \"" + name + "\": " + what +
                                      "; the file is cut off or damaged, export it again from its "
                                      "program");
}

// The text before the data of a PLY file. assimp 5.2 reads for ever in a header that is cut off or
// damaged, so every line must be one that the format knows, and in the lines of an ASCII file that
// is cut off, so all of them must be there.
void CheckPly(const std::string& bytes, const std::string& name) {
  static const std::regex kLine(
      "ply|format (ascii|binary_little_endian|binary_big_endian) 1\\.0|(comment|obj_info)[ -~]*|"
      "element \\w+ (\\d{1,9})|property (list \\w+ )?\\w+ \\w+|end_header");
  bool is_ascii = false;
  int64_t num_elements = 0;
  size_t begin = 0;
  std::string line;
  for (int line_number = 1; line != "end_header"; ++line_number) {
    const size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) FailDamaged(name, "its PLY header has no end_header");
    line = bytes.substr(begin, std::min<size_t>(end - begin, 256));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    std::smatch match;
    if (!std::regex_match(line, match, kLine)) {
      FailDamaged(name, "line " + std::to_string(line_number) +
                            " is not of a PLY header, or says more than 999999999 of something");
    }
    if (match[1] == "ascii") is_ascii = true;
    if (match[3].matched) num_elements += std::stoll(match[3]);
    begin = end + 1;
  }
  if (!is_ascii) return;
  int64_t num_lines =
      std::count(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end(), '\n');
  if (bytes.back() != '\n') ++num_lines;
  if (num_lines < num_elements) {
    FailDamaged(name, "it has " + std::to_string(num_lines) + " of " +
                          std::to_string(num_elements) + " lines after its PLY header");
  }
}

constexpr size_t kStlHead = 84, kStlTriangle = 50;  // bytes

// assimp wants an ASCII file in small letters and a binary one without a byte too many; the format
// does not. Only what it would refuse is changed.
std::string TidyStl(const std::string& bytes) {
  if (bytes.size() > kStlHead) {
    uint32_t num_triangles = 0;
    std::memcpy(&num_triangles, bytes.data() + kStlHead - sizeof num_triangles,
                sizeof num_triangles);
    const size_t size = kStlHead + kStlTriangle * static_cast<size_t>(num_triangles);
    // Text read as a count is larger than any such file: four printable bytes are 5e8 triangles.
    if (num_triangles > 0 && size == bytes.size()) return bytes;
    if (num_triangles > 0 && size < bytes.size()) return bytes.substr(0, size);
  }
  std::string head = bytes.substr(0, 5);
  const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
  std::transform(head.begin(), head.end(), head.begin(), lower);
  if (head != "solid") return bytes;
  std::string text = bytes;
  std::transform(text.begin(), text.end(), text.begin(), lower);
  return text;
}

// What a glTF file must be read with and is not.
void CheckGltf(const std::string& bytes, const std::string& name) {
  const size_t begin = bytes.find("\"extensionsRequired\"");
  if (begin == std::string::npos) return;
  const std::string required = bytes.substr(begin, bytes.find(']', begin) - begin);
  for (const char* extension :
       {"KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_draco_mesh_compression"}) {
    if (required.find(extension) == std::string::npos) continue;
    throw Error(ErrorKind::kFormat, "mesh \"" + name + "\" requires the glTF extension " +
                                        extension + ", which is not read; export it without");
  }
}

void ReadBehindFence(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  std::string format;
  Cross(arguments, format);
  TriMesh mesh = ReadForeignMesh(ReadFile(input.path()), format, input.name(),
                                 [&](const std::string& name) { return input.ReadBeside(name); });
  Cross(answer, mesh);
}

}  // namespace

TriMesh ReadForeignMesh(const std::string& bytes, const std::string& format,
                        const std::string& name, const ReadBeside& read_beside) {
  if (bytes.rfind("version https://git-lfs", 0) == 0) {
    throw Error(ErrorKind::kFormat, "mesh \"" + name +
                                        "\" is a Git LFS pointer, not the mesh itself; get it "
                                        "with: git lfs pull");
  }
  if (format == "obj") return ReadObj(bytes, name);
  if (format == "ply") CheckPly(bytes, name);
  if (format == "gltf" || format == "glb") CheckGltf(bytes, name);
  try {
    return ReadWithAssimp(format == "stl" ? TidyStl(bytes) : bytes, format, read_beside);
  } catch (const std::runtime_error& fault) {
    throw Error(ErrorKind::kFormat, "mesh \"" + name + "\" cannot be read (" +
                                        MakePrintable(fault.what()) +
                                        "); the file may be cut off or damaged, export it again "
                                        "from its program");
  }
}

FencedReader MakeMeshReader() { return {"mesh", &ReadBehindFence}; }

}  // namespace graspbench
