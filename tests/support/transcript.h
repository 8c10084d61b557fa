#pragma once
/** @file
What a program printed beside what it should print. In the expected text "..." stands for any text
within a line and, alone on a line, for any number of lines. */

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

inline std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline std::string JoinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

inline void DropEmptyTail(std::vector<std::string>& lines) {
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
}

inline bool MatchesLine(std::string_view line, std::string_view pattern) {
  const size_t dots = pattern.find("...");
  if (dots == std::string_view::npos) return line == pattern;
  if (line.substr(0, dots) != pattern.substr(0, dots)) return false;
  for (size_t start = dots; start <= line.size(); ++start) {
    if (MatchesLine(line.substr(start), pattern.substr(dots + 3))) return true;
  }
  return false;
}

inline bool Matches(const std::vector<std::string>& lines, size_t line,
                    const std::vector<std::string>& patterns, size_t pattern) {
  if (pattern == patterns.size()) return line == lines.size();
  if (patterns[pattern] == "...") {
    for (size_t next = line; next <= lines.size(); ++next) {
      if (Matches(lines, next, patterns, pattern + 1)) return true;
    }
    return false;
  }
  return line < lines.size() && MatchesLine(lines[line], patterns[pattern]) &&
         Matches(lines, line + 1, patterns, pattern + 1);
}

}  // namespace graspbench
