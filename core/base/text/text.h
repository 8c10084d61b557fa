#pragma once
/** @file
Numbers and counts as text, the same on every machine and in every locale, and decoding of UTF-8.
Units belong in table headings. A missing (non-finite) number is "n/a", never a plausible number.
Sentences with several numbers are composed with fmt::format, which is independent of the locale,
too. */

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

/** Formats with a fixed number of decimals: FormatFixed(0.0123, 3) = "0.012". Never "-0". */
std::string FormatFixed(double value, int decimals);

/** Formats with significant digits: FormatSignificant(0.001234, 3) = "0.00123". Very small or large
numbers look like "1.23e-07". */
std::string FormatSignificant(double value, int digits);

/** Formats a ratio in per cent with one decimal and a no-break space before the sign:
FormatPercent(0.9) = "90.0 %". */
std::string FormatPercent(double ratio);

/** "0.12 to 0.34". */
std::string FormatRange(double low, double high, int decimals);

/** "0.23 (0.12 to 0.34)"; the estimate alone if the range is NaN. */
std::string FormatWithRange(double estimate, double low, double high, int decimals);

/** Converts ASCII letters to lower case. */
std::string ToLower(std::string_view text);

/** Converts the first letter to upper case if it is ASCII. */
std::string Capitalise(std::string text);

/** "1 trial", "2 trials". */
std::string FormatCount(int64_t count, const std::string& singular);
/** "1 vertex is", "2 vertices are". */
std::string FormatCount(int64_t count, const std::string& singular, const std::string& plural);

/** "10" if all are counted, otherwise "6 of 10". */
std::string FormatCountOf(int64_t count, int64_t num_all);

/** Makes one plain key from several names: the lower-case letters, digits and underscores of each,
joined by hyphens. If a name has any other character, a hash of the full names is appended, so that
different names never share a key. */
std::string MakePlainKey(const std::vector<std::string>& names);

/** Returns whether the bytes are well-formed UTF-8 (table 3-7 of the Unicode standard): no overlong
form, no surrogate, nothing above U+10FFFF. */
bool IsUtf8(std::string_view bytes);

/** Returns whether text is UTF-16, which spreadsheets call "Unicode text": it begins with a byte
order mark, or with characters that alternate with zero bytes. */
bool IsUtf16(std::string_view bytes);

struct CodePoint {
  char32_t value = 0;
  size_t size = 0;  ///< [bytes]; 0: not valid UTF-8
};

/** Decodes the first character. @pre not empty. */
CodePoint ReadCodePoint(std::string_view bytes);

enum class LineFeeds { kKeep, kEscape };

/** Makes foreign text safe to show. File names and table cells may contain characters that move a
terminal's cursor, change its title or reverse the direction of text.

Escaped as a backslash, u and four digits are control characters (U+0000..1F, U+007F..9F), marks of
text direction (U+061C, U+200E/F, U+202A..2E, U+2066..69) and line and paragraph separators
(U+2028/9). Tabs are kept, and line feeds unless kEscape. Bytes that are not UTF-8 become a
backslash, x and two digits. All other text is returned unchanged. */
std::string EscapeForTerminal(std::string_view text, LineFeeds line_feeds = LineFeeds::kKeep);

}  // namespace graspbench
