#include "core/base/text/json_cursor.h"

#include <charconv>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr int kMaxDepth = 50;  // of nested values; deeper texts are read as trees

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/** Length of the number at the start, by the grammar of RFC 8259; 0 when there is none. */
size_t FindNumberEnd(std::string_view text) {
  size_t at = 0;
  const auto is_at = [&](char c) { return at < text.size() && text[at] == c; };
  const auto skip_digits = [&] {
    const size_t start = at;
    while (at < text.size() && IsDigit(text[at])) ++at;
    return at > start;
  };
  if (is_at('-')) ++at;
  if (is_at('0')) {
    ++at;
  } else if (!skip_digits()) {
    return 0;
  }
  if (is_at('.')) {
    ++at;
    if (!skip_digits()) return 0;
  }
  if (is_at('e') || is_at('E')) {
    ++at;
    if (is_at('+') || is_at('-')) ++at;
    if (!skip_digits()) return 0;
  }
  return at;
}

}  // namespace

bool JsonCursor::TakeKey(std::string_view key, bool is_first) {
  const size_t start = is_first ? 0 : 1;
  const size_t length = start + key.size() + 3;
  if (has_failed_ || rest_.size() < length || (!is_first && rest_[0] != ',') ||
      rest_[start] != '"' || rest_.substr(start + 1, key.size()) != key ||
      rest_[length - 2] != '"' || rest_[length - 1] != ':') {
    return false;
  }
  rest_.remove_prefix(length);
  return true;
}

std::string_view JsonCursor::ReadNumberLetters() {
  const std::string_view letters = rest_.substr(0, has_failed_ ? 0 : FindNumberEnd(rest_));
  if (letters.empty()) Fail();
  rest_.remove_prefix(letters.size());
  return letters;
}

double JsonCursor::ReadNumber() {
  const std::string_view letters = ReadNumberLetters();
  double value = 0.0;
  // A tree reads "-0" as an integer, which has no sign.
  if (letters == "-0" || std::from_chars(letters.begin(), letters.end(), value).ec != std::errc()) {
    Fail();
  }
  return value;
}

int JsonCursor::ReadInt() {
  const std::string_view letters = ReadNumberLetters();
  int value = 0;
  const auto [end, status] = std::from_chars(letters.begin(), letters.end(), value);
  if (status != std::errc() || end != letters.end()) Fail();
  return value;
}

std::string_view JsonCursor::ReadPlainText() {
  const std::string_view start = rest_;
  SkipString(/*may_be_escaped=*/false);
  return has_failed_ ? std::string_view() : start.substr(1, start.size() - rest_.size() - 2);
}

std::string_view JsonCursor::ReadValue() {
  const std::string_view start = rest_;
  SkipValue(0);
  return has_failed_ ? std::string_view() : start.substr(0, start.size() - rest_.size());
}

void JsonCursor::SkipString(bool may_be_escaped) {
  constexpr std::string_view kEscapes = "\"\\/bfnrt";
  Demand("\"");
  bool is_ascii = true;
  size_t at = 0;
  while (!has_failed_ && at < rest_.size() && rest_[at] != '"') {
    const auto letter = static_cast<unsigned char>(rest_[at]);
    is_ascii = is_ascii && letter < 0x80;
    if (letter < 0x20) return Fail();
    if (letter == '\\') {
      const bool is_known = at + 1 < rest_.size() && kEscapes.find(rest_[at + 1]) != kEscapes.npos;
      if (!may_be_escaped || !is_known) return Fail();
      ++at;
    }
    ++at;
  }
  if (has_failed_ || at >= rest_.size()) return Fail();
  if (!is_ascii && !IsUtf8(rest_.substr(0, at))) return Fail();
  rest_.remove_prefix(at + 1);
}

void JsonCursor::SkipList(char end, bool has_keys, int depth) {
  rest_.remove_prefix(1);
  if (Take({&end, 1})) return;
  do {
    if (has_keys) {
      SkipString(/*may_be_escaped=*/true);
      Demand(":");
    }
    SkipValue(depth + 1);
  } while (Take(","));
  Demand({&end, 1});
}

void JsonCursor::SkipValue(int depth) {
  if (has_failed_ || rest_.empty() || depth > kMaxDepth) return Fail();
  switch (rest_[0]) {
    case '{':
      return SkipList('}', true, depth);
    case '[':
      return SkipList(']', false, depth);
    case '"':
      return SkipString(/*may_be_escaped=*/true);
    case 't':
      return Demand("true");
    case 'f':
      return Demand("false");
    case 'n':
      return Demand("null");
    default:
      ReadNumber();
  }
}

bool IsPlainJson(std::string_view text) {
  JsonCursor cursor(text);
  cursor.ReadValue();
  return !cursor.has_failed() && cursor.rest().empty();
}

}  // namespace graspbench
