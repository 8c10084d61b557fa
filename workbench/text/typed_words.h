#pragma once
/** @file
A command line of the shell as words, and words as what a command asks for. */

#include <string>
#include <vector>

namespace graspbench {

/** Words are parted by blanks; a quote of either kind at the start of a word keeps blanks up to its
like; "#" at the start of a word begins a comment. @throws Error(kUsage) for a quote without end. */
std::vector<std::string> SplitWords(const std::string& line);

/** "1.25", or "1.25s" with the unit "s".
@throws Error(kUsage) naming `what` and the range when it is no finite number within it. */
double ParseNumber(const std::string& word, const std::string& what, const std::string& unit,
                   double low, double high);
int ParseCount(const std::string& word, const std::string& what, int low, int high);

}  // namespace graspbench
