#pragma once
/** @file
Text in UTF-16, which spreadsheets write as "Unicode text" and nothing here reads. */

#include <string_view>

namespace graspbench {

/** Begins with a byte order mark of UTF-16, or with letters that have a zero beside each. */
bool IsUtf16(std::string_view bytes);

}  // namespace graspbench
