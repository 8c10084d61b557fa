#pragma once
/** @file
Words of a shell script. */

#include <string>

namespace graspbench {

/** A word that a shell reads as it is meant: plain when it can be, else in single quotes. */
std::string QuoteForShell(const std::string& text);

}  // namespace graspbench
