#pragma once
/** @file
Markup as a type, so that text from a file can never become a tag.

Only Text() and Element() make fragments of `Html`. They are well-formed XML as well as HTML 5
(every element closed, every attribute quoted), so any XML parser can check a page. A single
function escapes text and attribute values:

- & < > " ' become entities;
- invalid UTF-8, control characters and characters that change the text direction become U+FFFD, so
  that a name is shown as it is and cannot rearrange its surroundings. */

#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

struct Attribute {
  const char* name;   ///< ours, never from a file
  std::string value;  ///< anything
};
using Attributes = std::vector<Attribute>;

/** A sequence of elements and text. */
class Html {
 public:
  Html() = default;
  Html& operator+=(const Html& other) {
    markup_ += other.markup_;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return a += b; }
  bool empty() const { return markup_.empty(); }
  const std::string& markup() const { return markup_; }

 private:
  friend Html Text(std::string_view);
  friend Html Element(const char*, const Attributes&, const Html&);
  std::string markup_;
};

/** Escapes the text. */
Html Text(std::string_view text);

/** Makes `<tag attributes>content</tag>`; an HTML void element (img, br, col) is self-closed. Also
makes SVG elements. @pre a void element has no content. */
Html Element(const char* tag, const Attributes& attributes, const Html& content = {});
/** Makes an element that contains text. */
Html Element(const char* tag, const Attributes& attributes, std::string_view text);

/** Makes a link within the page. */
Html LinkTo(const std::string& anchor, std::string_view text);

/** Encodes bytes as in RFC 4648. */
std::string EncodeBase64(std::string_view bytes);

/** Makes "data:<type>;base64,..." for an image embedded in the page. */
std::string MakeDataUri(std::string_view media_type, std::string_view bytes);

}  // namespace graspbench
