#pragma once
/** @file
manifest.json: what a result folder consists of, so that damage is found before a number is shown.

    {"kind":"session","versions":{"program":"0.1.0","physics":6,"schema":4},
     "files":[{"path":"session.json","bytes":812,"sha256":".."},
              {"path":"journal/0.jsonl","bytes":90112,"sha256":"..","lines":210}],
     "sha256":".."}

A file without `lines` never changes. One with `lines` is a journal: it may only grow, and `bytes`
and `sha256` are of the lines that were committed when the manifest was written. The last member is
the SHA-256 of the manifest itself without it. The manifest is written whole, after the files it
names. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"

namespace graspbench {

struct ManifestFile {
  std::string path;          ///< from the folder, with slashes
  uintmax_t bytes = 0;       ///< in a journal: of the committed lines
  std::string sha256;        ///< of those bytes
  std::optional<int> lines;  ///< a journal: how many were committed
};

struct Manifest {
  std::string kind;  ///< "session", "scene", "campaign", "study"
  Json versions = Json::object();
  std::vector<ManifestFile> files;  ///< by path
};

/** What is wrong with a file that the manifest names, in words that follow its name. */
struct Damage {
  std::string path;
  std::string text;
};

/** Reads the file as it is now. @throws Error(kNotFound, kIo). */
ManifestFile SealFile(const std::filesystem::path& folder, const std::string& path);
/** The same for a journal, as far as its last whole line. */
ManifestFile SealJournal(const std::filesystem::path& folder, const std::string& path);

bool HasManifest(const std::filesystem::path& folder);
/** @throws Error(kNotFound), Error(kFormat) when it is damaged itself, Error(kIo). */
Manifest LoadManifest(const std::filesystem::path& folder);
/** The file's whole text: the same manifest, the same bytes. */
std::string FormatManifest(const Manifest& manifest);
/** @throws Error(kIo). */
void WriteManifest(const std::filesystem::path& folder, const Manifest& manifest);

/** Everything in which the folder's files are not what the manifest says; in its order. Files that
it does not name are not looked at. */
std::vector<Damage> FindDamage(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace graspbench
