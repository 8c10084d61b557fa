#pragma once
/** @file
Which parts of a mesh are one body: those that touch or cross each other, and a cavity with what
surrounds it. A rigid object that is simulated must be one body; a crumb that floats beside a can
would be lifted with it. */

#include "core/shape/repair/mesh_shells.h"

namespace graspbench {

/** Some bodies of a mesh. */
struct BodyCount {
  int count = 0;
  double volume = 0.0;                              ///< [m^3]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the first one [m]
};
struct Bodies {
  BodyCount apart;   ///< outside of all others, but for the largest body
  BodyCount nested;  ///< altogether inside others and facing outwards: that space counts twice
};

/** @param gap  parts that are nearer to each other touch [m]. Off by nothing where parts are closed
and their surfaces farther apart than that. @pre every shell is closed; finite vertices. */
Bodies FindBodies(const TriMesh& mesh, const Shells& shells, double gap);

}  // namespace graspbench
