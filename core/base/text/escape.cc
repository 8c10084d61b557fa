#include "core/base/text/escape.h"

#include <fmt/core.h>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

/** First and last of each range. */
constexpr char32_t kObeyed[][2] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x061C, 0x061C},
                                   {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}};

bool IsObeyed(char32_t c) {
  for (const auto& range : kObeyed) {
    if (c >= range[0] && c <= range[1]) return true;
  }
  return false;
}

}  // namespace

std::string EscapeForTerminal(std::string_view text, LineFeeds line_feeds) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const CodePoint c = ReadCodePoint(text);
    const size_t size = c.size > 0 ? c.size : 1;
    const bool is_kept = c.value == '\t' || (c.value == '\n' && line_feeds == LineFeeds::kKeep) ||
                         !IsObeyed(c.value);
    if (c.size == 0) {
      safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else if (is_kept) {
      safe += text.substr(0, size);
    } else {
      safe += fmt::format("\\u{:04x}", static_cast<unsigned>(c.value));
    }
    text.remove_prefix(size);
  }
  return safe;
}

}  // namespace graspbench
