#pragma once
/** @file
Converts Markdown (CommonMark with tables, parsed by cmark-gfm) into parts of a page of
reports/page. HTML in the text is refused: all output goes through Element() and Text(). */

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/page/layout.h"

namespace graspbench {

/** The text under one heading, for the search. */
struct ManualSection {
  std::string anchor;  ///< of the heading; empty for text before the first heading
  std::string title;
  std::string text;  ///< plain
};

struct ManualText {
  std::string title;     ///< the first-level heading
  std::string subtitle;  ///< the paragraph right below the title
  Html body;
  std::vector<ManualSection> sections;
  /** Table rows that begin with one word in code, such as a key or an option. The anchor is that
  word; if it is taken, the section's anchor precedes it: "sweepyaml.seed". The text of the sections
  does not contain these rows. */
  std::vector<ManualSection> rows;
};

struct MarkdownPlaces {
  std::string name;                ///< of the page, for messages
  std::filesystem::path pictures;  ///< folder to which picture links are relative
  /** Maps a link target to an address in the page. @throws Error(kFormat) when there is no such
  page. */
  std::function<std::string(const std::string& target)> find_link;
};

/** Converts a page. Pictures (PNG, SVG) are embedded. Second- and third-level headings get anchors
from their words. @throws Error(kFormat) naming page and line: no title, HTML, or a missing
picture. */
ManualText ReadMarkdown(const std::string& markdown, const MarkdownPlaces& places);

}  // namespace graspbench
