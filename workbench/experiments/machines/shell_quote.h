#pragma once
/** @file
Quoting for shell scripts. */

#include <string>

namespace graspbench {

/** Quotes a word for the shell: unchanged if it needs no quotes, else in single quotes. */
std::string QuoteForShell(const std::string& text);

}  // namespace graspbench
