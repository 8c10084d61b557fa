#pragma once
/** @file
One JSON object as one line of text, with a checksum against torn and damaged lines.

    {"trial_id":"..","hand":"tum",..,"xxh64":"0123456789abcdef"}

The last member is the checksum: XXH64 of all bytes of the line before `,"xxh64"`. So other programs
can read a journal as JSON Lines, and a flipped bit is detected before the line is parsed. */

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {

/** Formats the line without its line break. @pre `record` is an object with at least one member. */
std::string FormatCheckedLine(const Json& record);

/** Whether the line ends in the correct checksum; does not parse it. */
bool IsCheckedLine(std::string_view line);

/** Returns the part that the checksum covers; empty if the line does not end in it. */
std::string_view FindCheckedBody(std::string_view line);

/** @returns the object, its checksum included.
@throws Error(kFormat) saying what is wrong with the line: cut off, or its checksum. */
Json ParseCheckedLine(std::string_view line);

/** Returns `read(object)`. @throws Error(kFormat) as ParseCheckedLine, and when `read` throws. */
template <class Read>
auto ReadCheckedLine(std::string_view line, Read&& read) {
  const Json json = ParseCheckedLine(line);
  try {
    return read(json);
  } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
    throw Error(ErrorKind::kFormat, std::string("it is no record of this version: ") + e.what());
  }
}

/** Calls `take(line, number, is_whole)` for every non-empty line. The last one is whole only if it
ends in a line break. */
template <class Take>
void ForEachLine(const std::string& text, Take&& take) {
  int number = 1;
  for (size_t start = 0; start < text.size(); ++number) {
    const size_t end = std::min(text.find('\n', start), text.size());
    if (end > start) {
      take(std::string_view(text).substr(start, end - start), number, end < text.size());
    }
    start = end + 1;
  }
}

struct FileLine {
  std::string_view text;  ///< without the line break
  int number;             ///< one-based
  uintmax_t start;        ///< of the text in the file [bytes]
  bool is_whole;          ///< ends in a line break; false for the last one only
};
/** Calls `take` for every line of a file, including empty ones; holds one line in memory at a time.
@param start  position of the first line, which has number 1 [bytes]. @throws as ReadFile. */
void ForEachLineOfFile(const std::filesystem::path& path,
                       const std::function<void(const FileLine&)>& take, uintmax_t start = 0);

/** Describes a JSON fault as the end of a sentence that names the file: "it is no JSON from line 1,
column 3 on", "its key "schema" is missing", or a value of the wrong type. */
std::string DescribeJsonFault(const Json::exception& fault);

}  // namespace graspbench
