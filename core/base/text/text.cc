#include "core/base/text/text.h"

#include <fmt/core.h>
#include <utf8cpp/utf8.h>

#include <cmath>

#include "core/base/hash.h"

namespace graspbench {
namespace {

constexpr char kNoBreakSpace[] = "\u00A0";

std::string DropSignOfZero(std::string text) {
  const bool is_minus_zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return is_minus_zero ? text.substr(1) : text;
}

/** First and last code point of each range of control characters that terminals obey. */
constexpr char32_t kObeyed[][2] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x061C, 0x061C},
                                   {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}};

bool IsObeyed(char32_t c) {
  for (const auto& range : kObeyed) {
    if (c >= range[0] && c <= range[1]) return true;
  }
  return false;
}

}  // namespace

std::string FormatFixed(double value, int decimals) {
  return std::isfinite(value) ? DropSignOfZero(fmt::format("{:.{}f}", value, decimals)) : "n/a";
}

std::string FormatSignificant(double value, int digits) {
  return std::isfinite(value) ? DropSignOfZero(fmt::format("{:.{}g}", value, digits)) : "n/a";
}

std::string FormatPercent(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) + kNoBreakSpace + "%" : "n/a";
}

std::string FormatRange(double low, double high, int decimals) {
  return FormatFixed(low, decimals) + " to " + FormatFixed(high, decimals);
}

std::string FormatWithRange(double estimate, double low, double high, int decimals) {
  const std::string text = FormatFixed(estimate, decimals);
  return std::isfinite(low) ? text + " (" + FormatRange(low, high, decimals) + ")" : text;
}

std::string FormatCountOf(int64_t count, int64_t num_all) {
  const std::string text = std::to_string(count);
  return count == num_all ? text : text + " of " + std::to_string(num_all);
}

std::string ToLower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string Capitalise(std::string text) {
  if (!text.empty() && 'a' <= text[0] && text[0] <= 'z') text[0] += 'A' - 'a';
  return text;
}

std::string FormatCount(int64_t count, const std::string& singular) {
  return FormatCount(count, singular, singular + "s");
}

std::string FormatCount(int64_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string MakePlainKey(const std::vector<std::string>& names) {
  std::string anchor, full;
  bool is_exact = true;
  for (const std::string& name : names) {
    if (!anchor.empty()) anchor += '-';
    is_exact = is_exact && !name.empty();
    for (char c : name) {
      const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
      is_exact = is_exact && is_plain;
      if (is_plain) {
        anchor += c;
      } else if (!anchor.empty() && anchor.back() != '-') {
        anchor += '-';
      }
    }
    full += name;
    full += '\0';
  }
  return is_exact ? anchor : anchor + "-" + CalcHashHex(full);
}

bool IsUtf8(std::string_view bytes) { return utf8::is_valid(bytes.begin(), bytes.end()); }

CodePoint ReadCodePoint(std::string_view bytes) {
  // Reads four bytes, the most of any character: only an error at the front matters.
  const std::string_view front = bytes.substr(0, 4);
  if (utf8::find_invalid(front.begin(), front.end()) == front.begin()) return {};
  auto next = front.begin();
  const char32_t value = utf8::unchecked::next(next);
  return {value, static_cast<size_t>(next - front.begin())};
}

bool IsUtf16(std::string_view bytes) {
  const std::string_view mark = bytes.substr(0, 2);
  if (mark == "\xff\xfe" || mark == "\xfe\xff") return true;
  constexpr size_t kLetters = 4;
  if (bytes.size() < 2 * kLetters) return false;
  for (const size_t zero : {0, 1}) {
    bool alternates = true;
    for (size_t i = 0; i < 2 * kLetters; ++i) {
      alternates = alternates && (i % 2 == zero ? bytes[i] == '\0' : bytes[i] >= ' ');
    }
    if (alternates) return true;
  }
  return false;
}

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
