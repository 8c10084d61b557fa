#pragma once
/** @file
manifest.json: what a result folder consists of, so that damage is found before a number is shown.

    {"kind":"session","versions":{"program":"0.1.0","physics":6,"schema":4},
     "files":[{"path":"session.json","bytes":812,"sha256":".."},
              {"path":"journal/0.jsonl","bytes":90112,"sha256":"..","lines":210}],
     "sha256":".."}

What was made from something else has a member `made` too: the command, versions of program, commit,
physics and judge, and the hashes that its inputs had.

A file without `lines` never changes. One with `lines` is a journal: it may only grow, and `bytes`
and `sha256` are of what it held when the manifest was written. The last member is the SHA-256 of
the manifest itself without it. The manifest is written whole. What was appended to a journal since
is good line by line, by the checksums of checked_line.h. */

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
  std::string path;          ///< from the folder, with slashes
  uintmax_t bytes = 0;       ///< in a journal: of the committed lines
  std::string sha256;        ///< of those bytes
  std::optional<int> lines;  ///< a journal: how many line breaks were committed

  template <class V>
  static void ListFields(V&& field) {
    field("path", &ManifestFile::path);
    field("bytes", &ManifestFile::bytes);
    field("sha256", &ManifestFile::sha256);
    field("lines", &ManifestFile::lines);
  }
};

/** What something was made from. */
struct ManifestSource {
  std::string path;    ///< from the folder; with a star several files
  std::string sha256;  ///< then

  template <class V>
  static void ListFields(V&& field) {
    field("path", &ManifestSource::path);
    field("sha256", &ManifestSource::sha256);
  }
};

/** How the files of a folder came about. */
struct ManifestOrigin {
  std::string command;             ///< that makes them again; without names of places
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
  std::string inputs;  ///< hash of what the results depend on besides; empty: not kept
  std::optional<ManifestOrigin> origin;  ///< of what was made from something else
  bool is_made_anew = false;             ///< by a repair, because the first one was lost
  std::vector<ManifestFile> files;       ///< by path

  /** Null: it does not name the file. */
  const ManifestFile* Find(const std::string& path) const;
};

/** What is wrong with a file, in words that follow its name. */
struct Damage {
  std::string path;
  int line = 0;  ///< one-based; 0: the file as a whole
  std::string text;
};

/** One line each, indented, at most ten: "\n  journal/0.jsonl:2: its bytes ..". */
std::string FormatDamage(const std::vector<Damage>& damages);

/** The same as the end of a sentence, for the first line of a report; empty when there is none. */
std::string DescribeDamage(const std::vector<Damage>& damages);

/** Reads the file as it is now, piece by piece. @throws Error(kNotFound, kIo). */
ManifestFile SealFile(const std::filesystem::path& folder, const std::string& path);
/** The same for a journal. A last line without its line break is left out, unless the next one will
be written behind it. */
ManifestFile SealJournal(const std::filesystem::path& folder, const std::string& path,
                         bool with_torn_line);

bool HasManifest(const std::filesystem::path& folder);
/** None when there is none that can be read. */
[[nodiscard]] std::optional<Manifest> FindManifest(const std::filesystem::path& folder);
/** @throws Error(kNotFound), Error(kFormat) when it is damaged itself, Error(kIo). */
Manifest LoadManifest(const std::filesystem::path& folder);
/** The same manifest, the same bytes. @throws Error(kIo). */
void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest);

/** In a handler of an Error about a file: rethrows it where the disk or the network failed
(Error(kIo)), which is no damage of the file. A folder or a device in its place is. */
void RethrowUnlessDamage(const std::filesystem::path& path);

/** Everything in which the folder's files are not what the manifest says; in its order. Files that
it does not name are not looked at. */
[[nodiscard]] std::vector<Damage> FindDamage(const std::filesystem::path& folder,
                                             const Manifest& manifest);

/** By the folder's manifest and lengths alone, which takes a moment: files that are gone or have
lost bytes. None without a manifest that can be read. */
[[nodiscard]] std::vector<Damage> FindLostBytes(const std::filesystem::path& folder);

/** Whole lines of a journal behind its first `committed` bytes that are no checked lines. */
[[nodiscard]] std::vector<Damage> FindBadLines(const std::filesystem::path& folder,
                                               const std::string& path, uintmax_t committed);

/** What a store's results come from, as hashes that say whether something made of them is out of
date.

A journal counts by its content: the whole lines of all its files, each once, in an order of their
own. So a session has the same hashes whoever ran which trial, how often it was continued, and after
a merge.

SHA-256 of the sorted SHA-256 digests (hexadecimal, a line each) of the different checked lines
in the files that match; lines that are torn or damaged count not. @throws Error(kIo). */
std::string CalcJournalSha256(const std::filesystem::path& folder, const std::string& pattern);

/** Files, kinds of files and journals of the store, and the stores in it, by the names that
StoreKind has for them; a file that is not there is left out, a journal that is not has the hash of
nothing. Who worked on it (workers/) is no part.
@param only  of those names; with the pattern of stores all of them, and as one more source which
there are; empty: all. @throws Error(kIo). */
std::vector<ManifestSource> ListSources(const StoreKind& kind, const std::filesystem::path& folder,
                                        const std::vector<std::string>& only = {});

/** Of a file its SHA-256; of a store that of its sources; of another result that of its manifest.
Empty for what is nothing of these. @throws Error(kIo). */
std::string CalcSourceSha256(const std::filesystem::path& path);

/** The sources among those of `origin` that are not any more what they were, by their names.
@param folder  of the manifest. Inside a store it is an output of, its sources are the store's. A
source that is not to be found says nothing. @throws Error(kIo). */
std::vector<std::string> FindChangedSources(const std::filesystem::path& folder,
                                            const ManifestOrigin& origin);

}  // namespace graspbench
