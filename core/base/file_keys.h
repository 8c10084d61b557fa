#pragma once
/** @file
The keys of a file format, a row each: its reader takes the ranges from them, `graspbench help FILE`
prints them, the JSON Schema is made of them. The listing of a configuration (config.h) makes its
rows; a test compares those written by hand with what their reader asks for. */

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graspbench {

/** Of a key that must be there. */
inline constexpr const char* kRequired = "required";
/** The least number above 0, as a limit. */
inline constexpr double kAboveZero = std::numeric_limits<double>::min();
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

enum class KeyType {
  kAny,           ///< a text, several, or a map of the keys below it; with limits a number
  kBoolean,       //
  kNumber,        ///< or several
  kNumberOfSome,  ///< the same; some entries of a list need it, others must not have it
  kList,          ///< of the keys below it
  kMap            ///< whose names are free
};

struct FileKey {
  FileKey(std::string name, std::string or_else, std::string about, double least = -kNoLimit,
          double most = kNoLimit)
      : FileKey(std::move(name), std::move(or_else), KeyType::kAny, std::move(about), least, most) {
  }
  FileKey(std::string name, std::string or_else, KeyType its_type, std::string about,
          double least = -kNoLimit, double most = kNoLimit)
      : key(std::move(name)),
        fallback(std::move(or_else)),
        type(its_type),
        meaning(std::move(about)),
        low(least),
        high(most) {}

  std::string key;       ///< in full: "palm.centre_m"; of the entries of a list: "digits.tip_m"
  std::string fallback;  ///< what holds where it is left out, kRequired, or empty: see `meaning`
  KeyType type;
  std::string meaning;  ///< without full stop
  double low, high;     ///< of a number, or of each of several
};
using FileKeys = std::vector<FileKey>;

/** What a configuration's listing says of a field beside its key; of a struct: what holds for those
of its fields that say nothing. The default stands in the struct; a `fallback` is what its help says
instead, as "none" of an empty text. */
struct KeyInfo {
  constexpr KeyInfo(const char* about = "", double least = -kNoLimit, double most = kNoLimit)
      : meaning(about), low(least), high(most) {}
  constexpr KeyInfo(const char* about, std::string_view or_else, double least = -kNoLimit,
                    double most = kNoLimit)
      : meaning(about), fallback(or_else), low(least), high(most) {}
  constexpr KeyInfo(const char* about, KeyType its_type) : meaning(about), type(its_type) {}

  const char* meaning;
  std::string_view fallback = {};
  KeyType type = KeyType::kAny;  ///< else that of the field's C++ type
  double low = -kNoLimit, high = kNoLimit;
};

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
