#pragma once
/** @file
A fuzz target: what is done with any bytes. A fault is a crash, a failed demand or an exception that
the target does not catch. */

#include <string>

#include "core/base/error.h"

namespace graspbench {

/** Each target has its own. */
void FuzzInput(const std::string& bytes);

/** Refused with an Error, or what is read is written, and that is read as the same. */
template <class Parse, class Format>
void FuzzRoundTrip(const std::string& text, const Parse& parse, const Format& format) {
  try {
    const std::string written = format(parse(text));
    GRASPBENCH_DEMAND(format(parse(written)) == written, written);
  } catch (const Error&) {
  }
}

}  // namespace graspbench
