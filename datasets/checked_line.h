#pragma once
/** @file
One JSON object as one line of text, safe against torn and damaged bytes.

    {"trial_id":"..","hand":"tum",..,"xxh64":"0123456789abcdef"}

The last member is the checksum: XXH64 of all bytes of the line before `,"xxh64"`. So a journal is
JSON Lines to every other program, and a flipped bit is found before the line is parsed. */

#include <string>
#include <string_view>

#include "core/base/json.h"

namespace graspbench {

/** Without the line break. @pre `record` is an object with at least one member. */
std::string FormatCheckedLine(const Json& record);

/** @returns the object, its checksum included.
@throws Error(kFormat) saying what is wrong with the line: cut off, or its checksum. */
Json ParseCheckedLine(std::string_view line);

}  // namespace graspbench
