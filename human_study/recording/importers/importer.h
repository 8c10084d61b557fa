#pragma once
/** @file
Reads motion capture in any known format.

An importer is one `.cc` file and one line in importer_list.inc. It reads from a stream, never
trusts a count before comparing it with what the file can hold, notes every deviation it accepts in
Recording::findings, and throws Error(kFormat) with the byte or line of a fault that it cannot
accept. */

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/fence/serve_fence.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** Position of a trial's rows in a plain table; rows of other trials may lie between them. */
struct TableRows {
  int64_t begin = 0;  ///< of the first row [bytes]
  int first_line = 0, last_line = 0;
};

struct ImportOptions {
  std::string format;  ///< an importer's id; empty: found by content, then by extension
  std::string unit;    ///< length unit for a file that does not state one
  /** Reads a truncated file up to its end instead of refusing it. */
  bool accept_truncated = false;
  /** C3D: trust residuals that mark every sample of the file as invalid. Some programs write -1
  everywhere; by default the coordinates are then used, with a finding. */
  bool trust_residuals = false;
  std::filesystem::path mapping;  ///< YAML that names the columns of a plain table
  std::string trial;              ///< plain table: the trial to read when one file holds several
  std::optional<TableRows> rows;  ///< plain table: only these rows are read; see FindTableTrials
};

/** Input of an importer. */
struct ImportSource {
  std::istream& stream;  ///< binary, seekable, at its start
  std::string name;      ///< for messages: the path as the user gave it
  /** Returns the content of a file beside this one (name only, no folder); nothing when there is
  none. */
  std::function<std::optional<std::string>(const std::string&)> read_sibling;
};

/** A text found by a redactor, with its location. */
struct PersonalField {
  std::string where;  ///< "SUBJECT:NAME", "line 1"
  std::string text;   ///< as in the file
};

struct Importer {
  const char* id;
  const char* title;
  std::vector<std::string>
      extensions;  ///< lower case, with the dot; a longer ending is possible: "_motion.tsv"
  /** Examines the first bytes (up to 4,096). Null: the content has no signature. */
  bool (*recognises)(std::string_view head);
  Recording (*import)(const ImportSource& source, const ImportOptions& options);
  /** Blanks personal data in a file's bytes in place, with unchanged length where positions matter,
  and returns what it blanked. Null: the format cannot contain any. */
  std::vector<PersonalField> (*redact)(std::string& bytes, const std::string& name);
};

/** All importers, in the order in which they examine the content. */
const std::vector<Importer>& ImporterList();

/** Finds the importer with this id, or the one that recognises the content or the extension.
@throws Error(kNotFound, kFormat) naming the formats. */
const Importer& FindImporter(const std::string& format, std::string_view head,
                             const std::filesystem::path& path);

/** Runs the importer and makes every text of the result safe to print: valid UTF-8 (other bytes are
read as Latin-1) without control characters. @throws as LoadRecording. */
Recording ImportRecording(const Importer& importer, const ImportSource& source,
                          const ImportOptions& options);

/** Reads a recording behind the fence (core/fence/fence.h), with its limits.
@throws Error(kNotFound, kIo, kFormat, kUnsupported); Error(kEnvironment) when it takes too long. */
Recording LoadRecording(const std::filesystem::path& path, const ImportOptions& options = {});

/** Writes a copy of `in` with personal data blanked; measurements keep every bit.
@throws as LoadRecording. */
std::vector<PersonalField> RedactRecording(const std::filesystem::path& in,
                                           const std::filesystem::path& out);

/** Readers of the program graspbench-reader, which carry out the functions with a path. */
std::vector<FencedReader> MakeRecordingReaders();

// Importers locate a fault by byte in binary files and by line in text files.
[[noreturn]] inline void FailAtByte(const std::string& file, uint64_t byte,
                                    const std::string& text) {
  throw Error(ErrorKind::kFormat, file + ": byte " + std::to_string(byte) + ": " + text);
}

[[noreturn]] inline void FailAtLine(const std::string& file, int line, const std::string& text) {
  throw Error(ErrorKind::kFormat, file + ":" + std::to_string(line) + ": " + text);
}

// Declares Make<Name>Importer() for every line of importer_list.inc.
#define GRASPBENCH_IMPORTER(name) Importer Make##name##Importer();
#include "human_study/recording/importers/importer_list.inc"
#undef GRASPBENCH_IMPORTER

}  // namespace graspbench
