#pragma once
/** @file
Numbers and counts as text, the same on every machine and in every locale; UTF-8 read one character
at a time. Units stand in table heads; what is missing (not finite) is "n/a", never a plausible
number. Sentences with several numbers are put together with fmt::format, which knows no locale
either. */

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

/** A fixed number of decimals: FormatFixed(0.0123, 3) = "0.012". Never "-0". */
std::string FormatFixed(double value, int decimals);

/** Significant digits: FormatSignificant(0.001234, 3) = "0.00123"; very small or large numbers in
the form "1.23e-07". */
std::string FormatSignificant(double value, int digits);

/** A ratio as per cent with one decimal and the sign after a no-break space: FormatPercent(0.9) =
"90.0 %". */
std::string FormatPercent(double ratio);

/** All letters small, of ASCII. */
std::string ToLower(std::string_view text);

/** The first letter large, of ASCII. */
std::string Capitalise(std::string text);

/** "1 trial", "2 trials". */
std::string FormatCount(int64_t count, const std::string& singular);
/** "1 vertex is", "2 vertices are". */
std::string FormatCount(int64_t count, const std::string& singular, const std::string& plural);

/** One plain word for several names: lower-case letters, digits and underscores of each, joined by
hyphens. Names with anything else get a hash of the full names as well, so different names never
share a key. */
std::string MakePlainKey(const std::vector<std::string>& names);

/** Well-formed after table 3-7 of the Unicode standard: no overlong form, no surrogate, nothing
past U+10FFFF. */
bool IsUtf8(std::string_view bytes);

struct CodePoint {
  char32_t value = 0;
  size_t size = 0;  ///< bytes; 0: what stands there is not UTF-8
};

/** The character at the front. @pre not empty. */
CodePoint ReadCodePoint(std::string_view bytes);

}  // namespace graspbench
