#pragma once
/** @file
A hand from a foreign description, in the project's own form: `hand.urdf` with balls, cylinders and
boxes to touch with and OBJ pictures, `hand.yaml` whose guesses are marked, `README.md`, and
`import.json` with all of it as data (write_hand.h).

What can be repaired is repaired and reported as a warning; an error is what nobody can know: what
touches where a mesh is missing, which link is the palm of an arm, how a ring of joints moves, which
unit a hand of 100 m is drawn in.

Not modelled: torques of a linkage beyond its ratio, tendons, springs, joint friction, textures,
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

/** @param text  of the description; `source` says where it lies and reads its meshes.
@param palm  name of the palm's link; empty: guessed. What a named palm leaves out need neither
exist nor be understood. @param problems  also what was repaired; with
an error there are no files. The files load without error (core/hand/load_hand.h). */
ImportedFiles ImportHand(const std::string& text, const HandSource& source, const std::string& palm,
                         Diagnostics& problems);

}  // namespace graspbench
