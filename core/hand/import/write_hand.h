#pragma once
/** @file
An imported hand as files of the project's own form. */

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/json.h"
#include "core/hand/import/shapes/load_shapes.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Name below the hand's folder -> content: hand.urdf, hand.yaml with a comment for every guess,
README.md with what was repaired, meshes/. @param source  name of the description, without folder.
@param problems  of the import: the README lists them. */
std::map<std::string, std::string> FormatHandFiles(const ImportedHand& imported,
                                                   const std::string& source,
                                                   const Diagnostics& problems);

/** `import.json`: where an imported hand comes from, as data, so that an import can be repeated and
compared.

    {"format": 1, "tool": "graspbench 1.0", "source": {"file": "hand.urdf", "sha256": ".."},
     "read": {"palm.stl": "sha256..", ..},
     "options": {"palm": "", "palm_normal": null, "unit_m": 0, "mesh_unit_m": 0, "package_path": [],
                 "angle": ""},
     "repairs": [{"line": 12, "text": ".."}],
     "contact": [{"link": "palm", "balls": 140, "out": {"at_95_mm": 0.3, "most_mm": 0.5},
                  "sink": {..}, "palmar_out": {..}, "palmar_sink": {..},
                  "self_contact": {"capsules": 8, "within_5_mm": 0.93}}, ..],
     "guesses": {"palm": {..}, "digits": [..], ..},
     "files": {"hand.urdf": "sha256..", ..}}

`contact` is how far balls stick out of a link, and a probe ball of 5 mm sinks into it, at 95 of 100
points and at most, rounded to 10 micrometres, and which share of its surface is near a capsule
(core/hand/contact_fit.h). `read` is what the
description refers to, meshes and included files. `unit_m` 0: inferred. Paths are names without
their folder; of two files of one name the second is "palm.stl (2)". Folders of `package_path` are
relative to that of the description.

@param text  of the description. @param read  paths of what it refers to.
@param palm  as asked for. @param files  of the hand, by name. */
std::string FormatImportRecord(const std::string& text, const std::set<std::filesystem::path>& read,
                               const HandSource& source, const std::string& palm,
                               const ImportedHand& imported, const Diagnostics& problems,
                               const std::map<std::string, std::string>& files);

/** The list `contact` above. */
Json MakeContactJson(const std::vector<ContactFit>& fits);
/** That list in the import.json of a hand's folder; empty where there is none, or hand.urdf is not
the one that was imported. @throws Error(kFormat) for an import.json that lacks it, Error(kIo). */
std::vector<ContactFit> ReadContactFits(const std::filesystem::path& folder);

}  // namespace graspbench
