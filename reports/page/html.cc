#include "reports/page/html.h"

#include <algorithm>
#include <cstring>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

bool IsControl(char32_t c) {
  return (c < 0x20 && c != '\t' && c != '\n') || (c >= 0x7F && c < 0xA0) || c == 0xFFFE ||
         c == 0xFFFF;
}

bool IsDirectionMark(char32_t c) {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069);
}

void AppendEscaped(std::string_view text, std::string& markup) {
  while (!text.empty()) {
    const CodePoint c = ReadCodePoint(text);
    if (c.size == 0 || IsControl(c.value) || IsDirectionMark(c.value)) {
      markup += kReplacement;
    } else if (c.value == '&') {
      markup += "&amp;";
    } else if (c.value == '<') {
      markup += "&lt;";
    } else if (c.value == '>') {
      markup += "&gt;";
    } else if (c.value == '"') {
      markup += "&quot;";
    } else if (c.value == '\'') {
      markup += "&#39;";
    } else {
      markup += text.substr(0, c.size);
    }
    text.remove_prefix(c.size == 0 ? 1 : c.size);
  }
}

bool IsVoidElement(const char* tag) {
  for (const char* known : {"br", "col", "hr", "img"}) {
    if (std::strcmp(tag, known) == 0) return true;
  }
  return false;
}

}  // namespace

Html Text(std::string_view text) {
  Html html;
  AppendEscaped(text, html.markup_);
  return html;
}

Html Element(const char* tag, const Attributes& attributes, const Html& content) {
  Html html;
  std::string& markup = html.markup_;
  size_t size = 2 * std::strlen(tag) + 8 + content.markup_.size();
  for (const Attribute& attribute : attributes) {
    size += std::strlen(attribute.name) + 4 + attribute.value.size();
  }
  markup.reserve(size);  // a section may take 10 MB, and twice that while it grows
  markup += '<';
  markup += tag;
  for (const Attribute& attribute : attributes) {
    markup += ' ';
    markup += attribute.name;
    markup += "=\"";
    AppendEscaped(attribute.value, markup);
    markup += '"';
  }
  if (IsVoidElement(tag)) {
    GRASPBENCH_DEMAND(content.empty(), tag);
    markup += "/>";
    return html;
  }
  markup += '>';
  markup += content.markup_;
  markup += "</";
  markup += tag;
  markup += '>';
  return html;
}

Html Element(const char* tag, const Attributes& attributes, std::string_view text) {
  return Element(tag, attributes, Text(text));
}

Html LinkTo(const std::string& anchor, std::string_view text) {
  return Element("a", {{"href", "#" + anchor}}, text);
}

std::string EncodeBase64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[(group >> (18 - 6 * k)) & 63] : '=';
    }
  }
  return text;
}

std::string MakeDataUri(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + EncodeBase64(bytes);
}

}  // namespace graspbench
