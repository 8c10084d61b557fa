#pragma once
/** @file
What a surface brings into a contact. Every object and every link of a hand has one; how the two of
a contact are combined says core/physics/contact.h.

Stiffness is that of one contact point, f = k x, not of a material as such: a link has as many
points as its surface has balls. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/units.h"

namespace graspbench {

enum class Needed;
class YamlMap;

/** A soft layer on the surface, of a rubber that keeps its volume (Poisson's ratio 1/2). How it
gives way: core/physics/contact.h. */
struct SoftPad {
  double youngs_modulus = 0.0;  ///< [Pa]; 0: there is none, the surface is bare
  double depth = 0.0;           ///< beyond which it yields no more [m]
  double torsion_scale = 1.0;   ///< on the torsion radius of its patch of contact
};

/** Values that were left out are NaN: the other side of the contact, or the session, gives them. */
struct SurfaceMaterial {
  double friction_static = kUnset;   ///< Coulomb coefficient
  double friction_dynamic = kUnset;  ///< <= friction_static
  double stiffness = kUnset;         ///< k, normal, per contact point [N/m]
  double torsion_radius = kUnset;    ///< r: resists spin up to mu fn r [m]
  SoftPad pad = {};                  ///< of links of a hand: hand.yaml
  double relaxation_time = kUnset;   ///< tau of core/physics/contact.h; no key of a file [s]

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

/** The rows of these keys (core/base/file_keys.h). @param prefix  of each: "surfaces.". */
FileKeys ListSurfaceKeys(Needed friction, const std::string& prefix);

/** Reads the keys that are there into `surface` and reports what is out of range. Friction comes as
a pair, the static coefficient not below the dynamic one. */
void ReadSurface(YamlMap& map, Needed friction, SurfaceMaterial& surface);

}  // namespace graspbench
