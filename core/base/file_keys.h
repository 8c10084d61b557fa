#pragma once
/** @file
The keys of a file format, one row each. The reader takes the ranges from the rows, `graspbench help
FILE` prints them, and the JSON Schema is generated from them. Rows of a configuration (config.h)
come from its listing. A test compares rows that are written by hand with the keys that their reader
requests. */

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graspbench {

/** Fallback of a mandatory key. */
inline constexpr const char* kRequired = "required";
/** Lower limit that excludes 0: the smallest positive number. */
inline constexpr double kAboveZero = std::numeric_limits<double>::min();
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

enum class KeyType {
  kAny,      ///< string, list of strings, or map of the keys below it; a number if it has limits
  kBoolean,  //
  kNumber,   ///< one number or several
  kNumberOfSome,  ///< as kNumber; required in some entries of a list, not allowed in others
  kList,          ///< list of maps with the keys below it
  kMap            ///< map with free names
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

  std::string key;       ///< full name: "palm.centre_m"; for the entries of a list: "digits.tip_m"
  std::string fallback;  ///< default, kRequired, or empty: see `meaning`
  KeyType type;
  std::string meaning;  ///< without a full stop
  double low, high;     ///< range of the number, or of each of several
};
using FileKeys = std::vector<FileKey>;

/** Attributes of a field in a configuration's listing, besides its key. The attributes of a struct
apply to those of its fields that have none. The default value is the initialiser in the struct; a
`fallback` replaces it in the help, for example "none" for an empty string. */
struct KeyInfo {
  constexpr KeyInfo(const char* about = "", double least = -kNoLimit, double most = kNoLimit)
      : meaning(about), low(least), high(most) {}
  constexpr KeyInfo(const char* about, std::string_view or_else, double least = -kNoLimit,
                    double most = kNoLimit)
      : meaning(about), fallback(or_else), low(least), high(most) {}
  constexpr KeyInfo(const char* about, KeyType its_type) : meaning(about), type(its_type) {}

  const char* meaning;
  std::string_view fallback = {};
  KeyType type = KeyType::kAny;  ///< kAny: from the field's C++ type
  double low = -kNoLimit, high = kNoLimit;
};

/** Returns null if there is no such row. */
const FileKey* FindFileKey(const FileKeys& keys, const std::string& key);

/** Returns whether the value is in the key's range; false for NaN. */
bool IsInRange(const FileKey& key, double value);

/** Returns "0 to 45", "above 0" or "at least 1"; empty if the key has no limits. */
std::string FormatRange(const FileKey& key);

/** Returns the unit that the suffix of a key names: "N/m" for "contact_stiffness_n_per_m". Empty if
there is none. */
std::string FindUnit(const std::string& key);

/** Formats the help text: one line per key with range, unit and default, and its meaning below. */
std::string FormatFileKeys(const FileKeys& keys);

}  // namespace graspbench
