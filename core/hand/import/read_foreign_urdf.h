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

#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** @param file  name of the text in messages. @param in_degrees  unit of the joints' limits;
nothing: inferred. @returns a tree, links and joints in the file's order, mimics resolved to joints
that follow nobody; of no use when there are errors. */
ForeignHand ReadForeignUrdf(const std::string& text, const std::string& file, Diagnostics& problems,
                            std::optional<bool> in_degrees = {});

}  // namespace graspbench
