#pragma once
/** @file
Converts a foreign description of a hand to the project's own form: `hand.urdf` with balls,
cylinders and boxes for contact and OBJ meshes for display, `hand.yaml` with its guesses marked,
`README.md`, and `import.json` with all of it as data (write_hand.h).

Faults that can be repaired are repaired and reported as warnings. An error is what cannot be
inferred: the contact shape of a missing mesh, which link of an arm is the palm, how a ring of
joints moves, the unit of a hand of 100 m.

Not modelled: torques in a linkage beyond its ratio, tendons, springs, joint friction, textures,
colours within a mesh. */

#include <map>
#include <string>

#include "core/base/error.h"
#include "core/hand/import/shapes/load_shapes.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

struct ImportedFiles {
  std::map<std::string, std::string> files;  ///< name below the hand's folder -> content
  int num_digits = 0, num_joints = 0, num_driven = 0;
  std::vector<ContactFit> fits;  ///< as ImportedHand::fits
};

/** @param text  text of the description; `source` gives its location and loads its meshes.
@param palm  name of the palm's link; empty: guessed. Parts that a named palm leaves out may be
missing or invalid. @param problems  also receives all repairs; after an error there are no files.
@returns files that load without error (core/hand/load_hand.h). */
ImportedFiles ImportHand(const std::string& text, const HandSource& source, const std::string& palm,
                         Diagnostics& problems);

}  // namespace graspbench
