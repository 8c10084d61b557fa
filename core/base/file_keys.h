#pragma once
/** @file
The keys of a file format, a row each. Its reader takes the ranges from them, `graspbench help FILE`
prints them, and a test compares them with what the reader asks for. */

#include <limits>
#include <string>
#include <vector>

namespace graspbench {

/** Of a key that must be there. */
inline constexpr const char* kRequired = "required";
/** The least number above 0, as a limit. */
inline constexpr double kAboveZero = std::numeric_limits<double>::min();

struct FileKey {
  std::string key;       ///< in full: "palm.centre_m"; of the entries of a list: "digits.tip_m"
  std::string fallback;  ///< what holds where it is left out, kRequired, or empty: see `meaning`
  /// Without full stop. Begins with "list" of a list, "a map:" of a map whose names are free, and
  /// "of .." where a required key is needed of some entries only.
  std::string meaning;
  double low = -std::numeric_limits<double>::infinity();  ///< of a number, or of each of several
  double high = std::numeric_limits<double>::infinity();
};
using FileKeys = std::vector<FileKey>;

/** Null when there is no such row. */
const FileKey* FindFileKey(const FileKeys& keys, const std::string& key);

/** Not for a value that is no number. */
bool IsInRange(const FileKey& key, double value);

/** "0 to 45", "above 0", "at least 1"; empty when all numbers will do. */
std::string FormatRange(const FileKey& key);

/** The unit that the end of a key names: "N/m" of "contact_stiffness_n_per_m"; empty: none. */
std::string FindUnit(const std::string& key);

/** For people: a key to a line, its range, unit and default, and below it what it is. */
std::string FormatFileKeys(const FileKeys& keys);

}  // namespace graspbench
