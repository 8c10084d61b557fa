#pragma once
/** @file
Reading motion capture of any known format.

An importer is one `.cc` file and one line in importer_list.inc. It reads from a stream, never
trusts a count before comparing it with what the file can hold, notes every deviation it accepts in
Recording::findings, and throws Error(kFormat) with the byte or line of a fault it cannot accept. */

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

/** Where the rows of a trial stand in a plain table; rows of others may stand between them. */
struct TableRows {
  int64_t begin = 0;  ///< of the first one [bytes]
  int first_line = 0, last_line = 0;
};

struct ImportOptions {
  std::string format;  ///< an importer's id; empty: found by content, then by extension
  std::string unit;    ///< length unit for a file that does not state one
  /** Read a truncated file as far as it goes instead of refusing it. */
  bool accept_truncated = false;
  /** C3D: believe residuals that call every sample of the file invalid. Some writers put -1
  everywhere; by default their coordinates are used and a finding says so. */
  bool trust_residuals = false;
  std::filesystem::path mapping;  ///< YAML that names the columns of a plain table
  std::string trial;              ///< plain table: the trial to read when one file holds several
  std::optional<TableRows> rows;  ///< plain table: nothing else is read; see FindTableTrials
};

/** What an importer reads from. */
struct ImportSource {
  std::istream& stream;  ///< binary, seekable, at its start
  std::string name;      ///< for messages: the path as the user gave it
  /** Content of a file beside this one (name only, no folder); nothing when there is none. */
  std::function<std::optional<std::string>(const std::string&)> read_sibling;
};

/** A text found by a redactor, with the place it was found at. */
struct PersonalField {
  std::string where;  ///< "SUBJECT:NAME", "line 1"
  std::string text;   ///< as it stood in the file
};

struct Importer {
  const char* id;
  const char* title;
  std::vector<std::string>
      extensions;  ///< lower case, with the dot; may end in more: "_motion.tsv"
  /** Looks at the first bytes (up to 4,096). Null: the content has no signature. */
  bool (*recognises)(std::string_view head);
  Recording (*import)(const ImportSource& source, const ImportOptions& options);
  /** Blanks personal data in the bytes of a file in place, at unchanged length where positions
  matter, and reports what it blanked. Null: the format has no place for any. */
  std::vector<PersonalField> (*redact)(std::string& bytes, const std::string& name);
};

/** All importers, in the order in which content is tried. */
const std::vector<Importer>& ImporterList();

/** The importer with that id, or the one that recognises the content or the extension.
@throws Error(kNotFound, kFormat) naming the formats. */
const Importer& FindImporter(const std::string& format, std::string_view head,
                             const std::filesystem::path& path);

/** Runs the importer and makes every text of the result safe to print: valid UTF-8 (other bytes are
read as Latin-1) without control characters. @throws as LoadRecording. */
Recording ImportRecording(const Importer& importer, const ImportSource& source,
                          const ImportOptions& options);

/** Reads behind the fence (core/fence/fence.h), with its limits.
@throws Error(kNotFound, kIo, kFormat, kUnsupported); Error(kEnvironment) where it took too long. */
Recording LoadRecording(const std::filesystem::path& path, const ImportOptions& options = {});

/** Writes a copy of `in` with personal data blanked; measurements keep every bit.
@throws as LoadRecording. */
std::vector<PersonalField> RedactRecording(const std::filesystem::path& in,
                                           const std::filesystem::path& out);

/** Of graspbench-reader: what the functions with a path do there. */
std::vector<FencedReader> MakeRecordingReaders();

// How importers place a fault: by byte in binary files, by line in texts.
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
