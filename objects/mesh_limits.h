#pragma once
/** @file
Limits of a mesh file, and the unit of its numbers. */

#include <cstdint>

#include "core/shape/tri_mesh.h"

namespace graspbench {

inline constexpr int64_t kMaxMeshFileBytes = int64_t{256} << 20;  // 256 MB
inline constexpr int64_t kMaxMeshTriangles = 2'000'000;

/** The unit of a mesh file's numbers. No mesh format states it reliably: it comes from object.yaml,
from the user or from the size (InferLengthUnit). */
enum class LengthUnit { kM, kMm };

constexpr double MetresPer(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e-3; }
constexpr double UnitsPerMetre(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e3; }
constexpr const char* NameOf(LengthUnit unit) { return unit == LengthUnit::kM ? "m" : "mm"; }

/** Passes a mesh through the fence (core/fence/crossing.h). */
template <class Values>
void CrossMembers(Values& values, TriMesh& mesh) {
  Cross(values, mesh.vertices, mesh.triangles);
}

}  // namespace graspbench
