#pragma once
/** @file
Foreign text made safe to show: file names, table cells and parameter names may hold bytes that move
a terminal's cursor, change its title or turn the direction of the text. */

#include <string>
#include <string_view>

namespace graspbench {

enum class LineFeeds { kKeep, kEscape };

/** The text with everything visible that a terminal would obey instead of show: control characters
(U+0000..1F, U+007F..9F; tabs stay, and line feeds on demand), marks of text direction (U+061C,
U+200E/F, U+202A..2E, U+2066..69) and line and paragraph separators (U+2028/9) as a backslash, u and
four digits, bytes that are no UTF-8 as a backslash, x and two. Nothing else changes: text without
them is returned as it is. */
std::string EscapeForTerminal(std::string_view text, LineFeeds line_feeds = LineFeeds::kKeep);

}  // namespace graspbench
