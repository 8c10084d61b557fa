#pragma once
/** @file
Contact properties of a surface. Every object and every link of a hand has a SurfaceMaterial;
core/physics/contact.h defines how the two of a contact are combined.

The stiffness is that of one contact point, f = k x, not of a material: a link has as many contact
points as its surface has balls. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/units.h"

namespace graspbench {

enum class Needed;
class YamlMap;

/** A soft layer on the surface, made of incompressible rubber (Poisson's ratio 1/2).
core/physics/contact.h defines how it deforms. */
struct SoftPad {
  double youngs_modulus = 0.0;  ///< [Pa]; 0: no pad, the surface is bare
  double depth = 0.0;           ///< maximum indentation [m]
  double torsion_scale = 1.0;   ///< factor on the torsion radius of its contact patch
};

/** NaN marks a value that is not given; the other surface of the contact or the session supplies
it. */
struct SurfaceMaterial {
  double friction_static = kUnset;   ///< Coulomb coefficient
  double friction_dynamic = kUnset;  ///< <= friction_static
  double stiffness = kUnset;         ///< normal stiffness k per contact point [N/m]
  double torsion_radius = kUnset;    ///< r: resists torsion up to mu fn r [m]
  SoftPad pad = {};                  ///< of a hand's links, from hand.yaml
  double relaxation_time = kUnset;   ///< tau of core/physics/contact.h [s]; not read from files

  template <class V>
  void Visit(V&& v) {
    v("friction_static", friction_static,
      {"coefficient of friction with the other surface, sticking", 0, 5});
    v("friction_dynamic", friction_dynamic, {"the same, sliding; at most the static one", 0, 5});
    v("contact_stiffness_n_per_m", stiffness,
      {"of one contact point; else as the session has it", 100, 1e7});
    v("torsion_radius_m", torsion_radius,
      {"of a soft surface: resists turning on the spot", 0, 0.1});
  }
};

/** Returns the rows of these keys (core/base/file_keys.h).
@param prefix  prefix of each key: "surfaces.". */
FileKeys ListSurfaceKeys(Needed friction, const std::string& prefix);

/** Reads the given keys into `surface` and reports values that are out of range. Both friction
coefficients must be given together, the static one not below the dynamic one. */
void ReadSurface(YamlMap& map, Needed friction, SurfaceMaterial& surface);

}  // namespace graspbench
