#pragma once
/** @file
manifest.json: the files of a result folder with their hashes, so that damage is detected before any
number is shown.

    {"kind":"session","versions":{"program":"0.1.0","physics":6,"schema":4},
     "files":[{"path":"session.json","bytes":812,"sha256":".."},
              {"path":"journal/0.jsonl","bytes":90112,"sha256":"..","lines":210}],
     "sha256":".."}

Derived results also have a member `made`: the command, versions of program, commit, physics and
judge, and the hashes that the inputs had.

A file without `lines` never changes. A file with `lines` is a journal: it may only grow, and
`bytes` and `sha256` cover its contents when the manifest was written. The last member is the
SHA-256 of the manifest without this member. The manifest is written atomically. Lines appended to a
journal later are protected by their own checksums (checked_line.h). */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

inline constexpr char kManifestFile[] = "manifest.json";

struct ManifestFile {
  std::string path;          ///< relative to the folder, with slashes
  uintmax_t bytes = 0;       ///< for a journal, of the committed lines
  std::string sha256;        ///< of those bytes
  std::optional<int> lines;  ///< for a journal, number of committed line breaks

  template <class V>
  static void ListFields(V&& field) {
    field("path", &ManifestFile::path);
    field("bytes", &ManifestFile::bytes);
    field("sha256", &ManifestFile::sha256);
    field("lines", &ManifestFile::lines);
  }
};

/** An input of a derived result. */
struct ManifestSource {
  std::string path;    ///< relative to the folder; several files with a star
  std::string sha256;  ///< when the result was made

  template <class V>
  static void ListFields(V&& field) {
    field("path", &ManifestSource::path);
    field("sha256", &ManifestSource::sha256);
  }
};

/** How the files of a folder were made. */
struct ManifestOrigin {
  std::string command;             ///< that reproduces them, without paths
  Json versions = Json::object();  ///< program, commit, physics, judge
  std::vector<ManifestSource> inputs;

  template <class V>
  static void ListFields(V&& field) {
    using O = ManifestOrigin;
    field("command", &O::command);
    field(
        "versions", [](const O& origin) { return origin.versions; },
        [](const Json& json, O& origin) { origin.versions = json; });
    field("inputs", &O::inputs);
  }
};

struct Manifest {
  std::string kind;  ///< "session", "optimisation", "campaign", "study", "basin"
  Json versions = Json::object();
  std::string inputs;  ///< hash of other inputs of the results; empty: not recorded
  std::optional<ManifestOrigin> origin;  ///< of a derived result
  bool is_made_anew = false;             ///< rebuilt by a repair, because the first was lost
  std::vector<ManifestFile> files;       ///< by path

  /** Returns null if the manifest does not list the file. */
  const ManifestFile* Find(const std::string& path) const;
};

/** Damage of a file; `text` completes a sentence that begins with its name. */
struct Damage {
  std::string path;
  int line = 0;  ///< one-based; 0: the file as a whole
  std::string text;
};

/** Formats one indented line each, at most ten: "\n  journal/0.jsonl:2: its bytes ..". */
std::string FormatDamage(const std::vector<Damage>& damages);

/** Formats the damage as the end of a sentence, for the first line of a report; empty if there is
none. */
std::string DescribeDamage(const std::vector<Damage>& damages);

/** Hashes the present file, reading it in pieces. @throws Error(kNotFound, kIo). */
ManifestFile SealFile(const std::filesystem::path& folder, const std::string& path);
/** As SealFile(), for a journal. @param with_torn_line  includes a last line without its line
break, because the next line will be written after it. */
ManifestFile SealJournal(const std::filesystem::path& folder, const std::string& path,
                         bool with_torn_line);

bool HasManifest(const std::filesystem::path& folder);
/** Returns the manifest; none if it is missing or cannot be read. */
[[nodiscard]] std::optional<Manifest> FindManifest(const std::filesystem::path& folder);
/** @throws Error(kNotFound); Error(kFormat) when the manifest itself is damaged; Error(kIo). */
Manifest LoadManifest(const std::filesystem::path& folder);
/** Writes the manifest; equal manifests give equal bytes. @throws Error(kIo). */
void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest);

/** Call in the handler of an Error about a file. Rethrows a failure of disk or network
(Error(kIo)), which is not damage of the file. A folder or a device in place of the file is
damage. */
void RethrowUnlessDamage(const std::filesystem::path& path);

/** Lists all differences between the folder's files and the manifest, in its order. Ignores files
that it does not list. */
[[nodiscard]] std::vector<Damage> FindDamage(const std::filesystem::path& folder,
                                             const Manifest& manifest);

/** Lists files that are missing or have lost bytes, quickly, from the manifest and file lengths
alone. Empty without a readable manifest. */
[[nodiscard]] std::vector<Damage> FindLostBytes(const std::filesystem::path& folder);

/** Lists whole lines after the first `committed` bytes of a journal that are not valid checked
lines. */
[[nodiscard]] std::vector<Damage> FindBadLines(const std::filesystem::path& folder,
                                               const std::string& path, uintmax_t committed);

/** Hashes the content of journals, to detect derived results that are out of date. The hash covers
the distinct whole lines of all files, independent of their order. So a session has the same hash
whoever ran its trials, however often it was resumed, and after a merge.

The hash is the SHA-256 of the sorted SHA-256 digests (hexadecimal, one per line) of the distinct
checked lines in the matching files. Torn or damaged lines are ignored. @throws Error(kIo). */
std::string CalcJournalSha256(const std::filesystem::path& folder, const std::string& pattern);

/** Lists the sources of a store: its files, file patterns, journals and inner stores, by their
names in StoreKind. A missing file is left out; a missing journal has the hash of nothing. workers/
is excluded.
@param only  those names to list; the pattern of stores stands for all of them and adds their list
as one more source; empty: all. @throws Error(kIo). */
std::vector<ManifestSource> ListSources(const StoreKind& kind, const std::filesystem::path& folder,
                                        const std::vector<std::string>& only = {});

/** Returns the SHA-256 of a file, of a store's sources, or of another result's manifest; empty for
anything else. @throws Error(kIo). */
std::string CalcSourceSha256(const std::filesystem::path& path);

/** Lists the names of the sources in `origin` that have changed since. A source that cannot be
found does not count as changed.
@param folder  of the manifest. If it is an output inside a store, its sources are the store's.
@throws Error(kIo). */
std::vector<std::string> FindChangedSources(const std::filesystem::path& folder,
                                            const ManifestOrigin& origin);

}  // namespace graspbench
