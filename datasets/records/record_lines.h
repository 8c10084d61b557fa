#pragma once
/** @file
Where the lines of a session's records stand in its files. A session of many trials is held in memory
only as far as summaries ask; a record is read again as a whole where an export or a picture needs
it. */

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct LinePlace {
  int file = -1;        ///< in RecordLines::files; -1: there is no such line
  int number = 0;       ///< one-based
  uintmax_t start = 0;  ///< in the file [bytes]
  size_t length = 0;    ///< without the line break [bytes]
};

struct RecordLines {
  std::filesystem::path folder;
  std::vector<std::string> files;     ///< "journal/0.jsonl", from the folder
  std::vector<LinePlace> trials;      ///< of all records, in their order; or of the whole plan
  std::vector<LinePlace> judgements;  ///< of the same
};

/** "journal/0.jsonl:12". */
std::string NameOfLine(const RecordLines& lines, const LinePlace& place);

/** @pre place.file >= 0. @throws Error(kIo) when it cannot be read any more. */
std::string ReadLine(const RecordLines& lines, const LinePlace& place);

}  // namespace graspbench
