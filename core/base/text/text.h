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

/** "0.12 to 0.34". */
std::string FormatRange(double low, double high, int decimals);

/** "0.23 (0.12 to 0.34)"; the value alone where the range is NaN. */
std::string FormatWithRange(double estimate, double low, double high, int decimals);

/** All letters small, of ASCII. */
std::string ToLower(std::string_view text);

/** The first letter large, of ASCII. */
std::string Capitalise(std::string text);

/** "1 trial", "2 trials". */
std::string FormatCount(int64_t count, const std::string& singular);
/** "1 vertex is", "2 vertices are". */
std::string FormatCount(int64_t count, const std::string& singular, const std::string& plural);

/** "10", or "6 of 10" where not all are counted. */
std::string FormatCountOf(int64_t count, int64_t num_all);

/** One plain word for several names: lower-case letters, digits and underscores of each, joined by
hyphens. Names with anything else get a hash of the full names as well, so different names never
share a key. */
std::string MakePlainKey(const std::vector<std::string>& names);

/** Well-formed after table 3-7 of the Unicode standard: no overlong form, no surrogate, nothing
past U+10FFFF. */
bool IsUtf8(std::string_view bytes);

/** Whether text is UTF-16, which spreadsheets write as "Unicode text": it begins with a byte order
mark, or with letters that have a zero beside each. */
bool IsUtf16(std::string_view bytes);

struct CodePoint {
  char32_t value = 0;
  size_t size = 0;  ///< bytes; 0: what stands there is not UTF-8
};

/** The character at the front. @pre not empty. */
CodePoint ReadCodePoint(std::string_view bytes);

enum class LineFeeds { kKeep, kEscape };

/** Foreign text made safe to show: file names and table cells may hold bytes that move a terminal's
cursor, change its title or turn the direction of the text. What a terminal would obey instead of
show becomes visible: control characters (U+0000..1F, U+007F..9F; tabs stay, and line feeds on
demand), marks of text direction (U+061C, U+200E/F, U+202A..2E, U+2066..69) and line and paragraph
separators (U+2028/9) as a backslash, u and four digits, bytes that are no UTF-8 as a backslash, x
and two. Nothing else changes: text without them is returned as it is. */
std::string EscapeForTerminal(std::string_view text, LineFeeds line_feeds = LineFeeds::kKeep);

}  // namespace graspbench
