#pragma once
/** @file
Writes an imported hand as files of the project's own form. */

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

/** Returns content by name below the hand's folder: hand.urdf, hand.yaml with a comment on every
guess, README.md with the repairs, meshes/. @param source  file name of the description.
@param problems  those of the import, which the README lists. */
std::map<std::string, std::string> FormatHandFiles(const ImportedHand& imported,
                                                   const std::string& source,
                                                   const Diagnostics& problems);

/** Formats `import.json`: the origin of an imported hand as data, so that an import can be repeated
and compared.

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

`contact` states how far the balls stick out of a link and how far a probe ball of 5 mm sinks into
it, at 95 of 100 points and at most, rounded to 10 micrometres. It also gives the share of the
surface near a capsule (core/hand/contact_fit.h). `read` lists the files to which the description
refers: meshes and included files. `unit_m` 0 means inferred. Paths are file names without folder;
the second of two files of the same name is "palm.stl (2)". Folders of `package_path` are relative
to that of the description.

@param text  text of the description. @param read  paths to which it refers.
@param palm  name given by the user. @param files  files of the hand, by name. */
std::string FormatImportRecord(const std::string& text, const std::set<std::filesystem::path>& read,
                               const HandSource& source, const std::string& palm,
                               const ImportedHand& imported, const Diagnostics& problems,
                               const std::map<std::string, std::string>& files);

/** Formats the list `contact` above. */
Json MakeContactJson(const std::vector<ContactFit>& fits);
/** Reads that list from the import.json of a hand's folder. Returns an empty list if there is no
such file, or if hand.urdf is not the imported one. @throws Error(kFormat) if the list is missing,
Error(kIo). */
std::vector<ContactFit> ReadContactFits(const std::filesystem::path& folder);

}  // namespace graspbench
