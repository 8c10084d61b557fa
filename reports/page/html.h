#pragma once
/** @file
Markup as a type: what came from a file can never be taken for a tag.

A fragment of `Html` is made by Text() and Element() only, and is well-formed XML as well as HTML 5
(every element closed, every attribute quoted), so a page can be checked by any XML parser. Text and
attribute values are written by one escaping function:

- & < > " ' become entities;
- invalid UTF-8, control characters and characters that change the direction of the text around
  them become U+FFFD, so a name shows as what it is and cannot rearrange its neighbours. */

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

/** The text, escaped. */
Html Text(std::string_view text);

/** `<tag attributes>content</tag>`; an HTML void element (img, br, col) is closed in its tag. SVG
elements are made in the same way. @pre a void element has no content. */
Html Element(const char* tag, const Attributes& attributes, const Html& content = {});
/** The element with text in it. */
Html Element(const char* tag, const Attributes& attributes, std::string_view text);

/** A link within the page. */
Html LinkTo(const std::string& anchor, std::string_view text);

/** RFC 4648. */
std::string EncodeBase64(std::string_view bytes);

/** "data:<type>;base64,..." for an image inside the page. */
std::string MakeDataUri(std::string_view media_type, std::string_view bytes);

}  // namespace graspbench
