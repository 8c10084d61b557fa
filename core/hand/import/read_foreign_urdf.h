#pragma once
/** @file
A URDF from elsewhere, read for what it means: core/hand/read_urdf.h reads it as a foreign one; here
limits and mimics are judged. What is missing or odd is filled in or left out and reported as a
warning with its line. Only what leaves no hand is an error: no XML, a macro file that was not
expanded, no link, 1000 links, joints that form no tree.

    missing or reversed limits, an endless turn  given, exchanged, half a turn each way
    limits beyond one turn                       degrees: of the file when most are, else of the
                                                 joint
    <mimic> of itself, in a ring, of nobody      the joint gets a drive of its own
    joints that are planar or floating           fixed
    shapes without size or of unknown kind       left out
    a second link or joint of one name           renamed
    blanks, letters of any script in names       kept */

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** @param file  name of the text in messages. @param in_degrees  unit of the joints' limits;
nothing: inferred. @returns a tree, links and joints in the file's order, mimics resolved to joints
that follow nobody. With errors that all belong to links and joints (AreErrorsLocal) it serves to
select a part without these; with others it is empty. */
ForeignHand ReadForeignUrdf(const std::string& text, const std::string& file, Diagnostics& problems,
                            std::optional<bool> in_degrees = {});

/** A MuJoCo model (MJCF) from elsewhere, read for what it means. What is not read is told once by
kind with its place; only what leaves no hand is an error: no XML, a file that is missing, a place
that is no number.

    bodies, frames            links; a body with several joints becomes a chain
    joints                    hinge, slide; the zero of a joint is its place in the file (`ref`)
    free and ball joints      fixed: the arm of an experiment carries the hand
    masses                    <inertial>; where there is none those of the geoms: `mass`, else
                              `density` (1000 kg/m^3), of a mesh its volume; `inertiafromgeom` and
                              `inertiagrouprange` of the compiler
    geoms                     sphere, capsule, cylinder, box, ellipsoid, mesh (also where a simple
                              shape is to be fitted to one); touch unless contype and conaffinity
                              are 0; are seen in groups 0 to 2 where the link has no picture apart
    equality, tendon, actuator   mjcf_couplings.h
    scene around a hand       bodies below which no joint moves, the world's own shapes: left out
                              unless several parts hang on the world

Angles are degrees unless the compiler says radian; limits that look like the other unit are told.

Not modelled: geoms as shells, masses set as a whole (`settotalmass`), springs and friction of
joints, the convex hull in which MuJoCo lets a mesh touch.

True when the outermost element is `<mujoco>`. */
bool IsMjcf(const std::string& text);

/** @param file  name of the text in messages. @param folder  included files lie there.
@param in_degrees  instead of what the compiler says of angles.
@returns as ReadForeignUrdf; meshes have addresses relative to the folder. */
ForeignHand ReadForeignMjcf(const std::string& text, const std::string& file,
                            const std::filesystem::path& folder, Diagnostics& problems,
                            std::optional<bool> in_degrees = {});

}  // namespace graspbench
