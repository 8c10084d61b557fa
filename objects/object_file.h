#pragma once
/** @file
object.yaml: the properties of an object to grasp that its mesh does not hold.

    name: coffee mug
    mesh: mesh.stl                  # in the same folder; OBJ, STL, PLY, GLB or glTF
    mesh_unit: mm                   # m or mm
    mass_kg: 0.31                   # or density_kg_per_m3
    friction_static: 0.45           # against the hand
    friction_dynamic: 0.40          # at most the static one
    # the rest may be left out
    contact_stiffness_n_per_m: 5e4        # of one contact point; else as the session has it
    torsion_radius_m: 0.003               # of a soft surface
    size_m: [0.12, 0.085, 0.09]           # the mesh must have it within 0.1 mm
    compressible:                         # if soft: how fingertips compress it
      force_n: 0.7                        # of each
      sight_m: [0.12, 0.085, 0.09]        # at rest; the mesh must have it within 0.1 mm
      grasp_m: [0.12, 0.08, 0.08]         # where they press on both sides; from 0.6 of sight_m
      sight_guessed: true                 # nobody measured it; outputs say so
    centre_of_mass_m: [0.01, 0, 0]        # from the middle of the bounding box; else homogeneous
    best_grasp: {tum: g3, shadow: g1}     # by hand
    grasp_order: [g1, g3, g6, g2, g4]     # for hands not named above, best first
    approach: side                        # from where hands come: automatic, above, side
    separate_parts: true                  # the mesh's bodies do not touch, and move as one
    colour: [0.8, 0.2, 0.1]               # linear RGB */

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/units.h"
#include "core/shape/grasp_object.h"
#include "core/shape/repair/mesh_check.h"
#include "core/shape/surface_material.h"
#include "objects/mesh_limits.h"

namespace graspbench {

/** How fingertips compress an object whose size at rest is ObjectFile::size. */
struct Compression {
  double force = 0.0;                                                 ///< of each [N]
  Eigen::Vector3d size_of_grasp = Eigen::Vector3d::Constant(kUnset);  ///< under the force [m]
  bool is_sight_guessed = false;
};

/** Values that were left out are NaN. */
struct ObjectFile {
  std::string name;
  std::string mesh;  ///< file name beside object.yaml
  LengthUnit mesh_unit = LengthUnit::kM;
  double mass = kUnset;     ///< [kg]; either this
  double density = kUnset;  ///< [kg/m^3]; or this
  SurfaceMaterial surface;
  Eigen::Vector3d size = Eigen::Vector3d::Constant(kUnset);  ///< [m]
  std::optional<Compression> compression;
  Eigen::Vector3d p_OOcm = Eigen::Vector3d::Constant(kUnset);  ///< [m]
  std::map<std::string, std::string> best_grasp;               ///< by hand id
  std::vector<std::string> grasp_order;                        ///< empty: left out
  Approach approach = Approach::kAutomatic;
  bool has_separate_parts = false;                          ///< several bodies, apart
  Eigen::Vector3d colour = Eigen::Vector3d(0.8, 0.7, 0.5);  ///< linear RGB
};

/** Whether its mesh may consist of parts that do not touch. */
inline PartsApart PartsApartOf(const ObjectFile& file) {
  return file.has_separate_parts ? PartsApart::kMeant : PartsApart::kRefused;
}

/** Reads object.yaml.
@throws Error(kNotFound, kIo); Error(kFormat) listing every problem with its line. */
ObjectFile LoadObjectFile(const std::filesystem::path& path);
/** As LoadObjectFile(), for text in memory; `file` is its name in messages. */
ObjectFile ParseObjectFile(const std::string& text, const std::string& file);

/** The keys of object.yaml and their ranges, which the reader checks. */
const FileKeys& ListObjectKeys();

}  // namespace graspbench
