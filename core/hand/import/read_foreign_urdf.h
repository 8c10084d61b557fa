#pragma once
/** @file
Reads a foreign URDF. core/hand/read_urdf.h parses it; limits and mimics are judged here. Missing or
odd parts are filled in or left out and reported as a warning with their line. Only faults that
leave no hand are errors: no XML, an unexpanded macro file, no link, 1000 links, joints that form no
tree.

    missing limits                               from the joint that it follows, else fixed
    reversed limits, a continuous joint          exchanged, half a turn each way
    limits beyond one turn                       degrees: of the file when most are, else of the
                                                 joint
    <mimic> of itself, in a ring, of no joint    the joint gets a drive of its own
    planar or floating joints                    fixed
    shapes without size or of unknown kind       left out
    a second link or joint of the same name      renamed
    blanks, letters of any script in names       kept */

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** @param file  name of the text in messages. @param in_degrees  unit of the joint limits; nullopt:
inferred. @returns a tree with links and joints in the file's order and mimics resolved to joints
that follow no other. If all errors belong to links and joints (AreErrorsLocal), the tree serves to
select a part without them; after other errors it is empty. */
ForeignHand ReadForeignUrdf(const std::string& text, const std::string& file, Diagnostics& problems,
                            std::optional<bool> in_degrees = {});

/** Reads a foreign MuJoCo model (MJCF). Parts that are not read are reported once per kind with
their location. Only faults that leave no hand are errors: no XML, a missing file, a position that
is not a number.

    bodies, frames            links; a body with several joints becomes a chain
    joints                    hinge, slide; the zero of a joint is its pose in the file (`ref`)
    free and ball joints      fixed: the arm of an experiment carries the hand
    masses                    <inertial>, otherwise those of the geoms: `mass`, else `density`
                              (1000 kg/m^3), for a mesh by its volume; `inertiafromgeom` and
                              `inertiagrouprange` of the compiler
    geoms                     sphere, capsule, cylinder, box, ellipsoid, mesh (also where a simple
                              shape is to be fitted to one); they touch unless contype and
                              conaffinity are 0; they are visible in groups 0 to 2 where the link
                              has no separate visuals
    equality, tendon, actuator   mjcf_couplings.h
    scene around a hand       bodies below which no joint moves, the world's own shapes: left out
                              unless several parts are attached to the world

Angles are degrees unless the compiler says radian; limits that look like the other unit are
reported.

Not modelled: geoms as shells, total masses (`settotalmass`), springs and friction of joints, the
convex hull that MuJoCo uses for contact of a mesh.

Returns whether the outermost element is `<mujoco>`. */
bool IsMjcf(const std::string& text);

/** @param file  name of the text in messages. @param folder  folder of included files.
@param in_degrees  overrides the compiler's unit of angles.
@returns as ReadForeignUrdf; mesh addresses are relative to the folder. */
ForeignHand ReadForeignMjcf(const std::string& text, const std::string& file,
                            const std::filesystem::path& folder, Diagnostics& problems,
                            std::optional<bool> in_degrees = {});

}  // namespace graspbench
