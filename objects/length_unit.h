#pragma once
/** @file
The unit of a mesh file's numbers. No mesh format states it reliably:
object.yaml does, or the user, or the size shows it (InferLengthUnit). */

namespace graspbench {

enum class LengthUnit { kM, kMm };

constexpr double MetresPer(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e-3; }
constexpr double UnitsPerMetre(LengthUnit unit) { return unit == LengthUnit::kM ? 1.0 : 1e3; }
constexpr const char* NameOf(LengthUnit unit) { return unit == LengthUnit::kM ? "m" : "mm"; }

}  // namespace graspbench
