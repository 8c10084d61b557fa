#pragma once
/** @file How load_mesh.cc and the program that reads foreign mesh files (mesh_reader.cc) talk. The
program is started as `graspbench-mesh-reader FORMAT FOLDER` with the file's bytes as its standard
input; files that a glTF names are looked for in FOLDER (empty: nowhere). Its standard output holds,
if it returns kMeshRead: this head, num_vertices times three doubles in the file's unit,
num_triangles times three 32-bit indices; if it returns kMeshRefused: a sentence without full stop.
kMeshFault is a fault of the reader itself that a sanitizer has found. */

#include <cstdint>

namespace graspbench {

struct MeshReaderHead {
  int64_t num_vertices = 0;
  int64_t num_triangles = 0;
};

enum MeshReaderExit : int { kMeshRead = 0, kMeshRefused = 1, kMeshFault = 99 };

inline constexpr int kMeshReaderSeconds = 10;                     // of processor time
inline constexpr int kMeshReaderWallSeconds = 18;                 // also when it only waits
inline constexpr int64_t kMeshReaderMemory = int64_t{3} << 29;    // 1.5 GB of addresses
inline constexpr int64_t kMaxMeshFileBytes = int64_t{256} << 20;  // 256 MB
inline constexpr int64_t kMaxMeshTriangles = 2'000'000;

/** The unit of a mesh file's numbers. No mesh format states it reliably:
object.yaml does, or the user, or the size shows it (InferLengthUnit). */
enum class LengthUnit { kM, kMm };

constexpr double MetresPer(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e-3; }
constexpr double UnitsPerMetre(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e3; }
constexpr const char* NameOf(LengthUnit unit) { return unit == LengthUnit::kM ? "m" : "mm"; }

}  // namespace graspbench
