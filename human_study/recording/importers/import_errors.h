#pragma once
/** @file
How importers place a fault: by byte in binary files, by line in texts. */

#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace graspbench {

[[noreturn]] inline void FailAtByte(const std::string& file, uint64_t byte,
                                    const std::string& text) {
  throw Error(ErrorKind::kFormat, file + ": byte " + std::to_string(byte) + ": " + text);
}

[[noreturn]] inline void FailAtLine(const std::string& file, int line, const std::string& text) {
  throw Error(ErrorKind::kFormat, file + ":" + std::to_string(line) + ": " + text);
}

}  // namespace graspbench
