#pragma once
/** @file
One JSON object as one line of text, safe against torn and damaged bytes.

    {"trial_id":"..","hand":"tum",..,"xxh64":"0123456789abcdef"}

The last member is the checksum: XXH64 of all bytes of the line before `,"xxh64"`. So a journal is
JSON Lines to every other program, and a flipped bit is found before the line is parsed. */

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {

/** Without the line break. @pre `record` is an object with at least one member. */
std::string FormatCheckedLine(const Json& record);

/** Whether the line ends in the checksum of its bytes; it is not parsed. */
bool IsCheckedLine(std::string_view line);

/** What the checksum is of; empty when the line does not end in it. */
std::string_view FindCheckedBody(std::string_view line);

/** @returns the object, its checksum included.
@throws Error(kFormat) saying what is wrong with the line: cut off, or its checksum. */
Json ParseCheckedLine(std::string_view line);

/** `read(object)`. @throws Error(kFormat) as ParseCheckedLine, and where `read` throws. */
template <class Read>
auto ReadCheckedLine(std::string_view line, Read&& read) {
  const Json json = ParseCheckedLine(line);
  try {
    return read(json);
  } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
    throw Error(ErrorKind::kFormat, std::string("it is no record of this version: ") + e.what());
  }
}

/** Calls `take(line, number, is_whole)` for every non-empty line; the last one is whole only when
it ends in a line break. */
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
/** Every line of a file, the empty ones too; holds one line at a time.
@param start  where the first line begins, and is counted as number 1. @throws as ReadFile. */
void ForEachLineOfFile(const std::filesystem::path& path,
                       const std::function<void(const FileLine&)>& take, uintmax_t start = 0);

/** What is wrong with a JSON text: "it is no JSON from line 1, column 3 on", "its key "schema" is
missing", or that a value is not of its type: the end of a sentence that names the file. */
std::string DescribeJsonFault(const Json::exception& fault);

}  // namespace graspbench
