#pragma once
/** @file
Markdown (CommonMark with tables, read by cmark-gfm) as parts of a page of reports/page. Markup in
the text is refused: what reaches the page goes through Element() and Text(). */

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/page/layout.h"

namespace graspbench {

/** What stands under one heading, for the search. */
struct ManualSection {
  std::string anchor;  ///< of the heading; empty for what stands before the first
  std::string title;
  std::string text;  ///< plain
};

struct ManualText {
  std::string title;     ///< the heading of first order
  std::string subtitle;  ///< the paragraph right below it
  Html body;
  std::vector<ManualSection> sections;
  /** Rows of tables that begin with one word in code, as a key or an option: each has an anchor of
  its name, of a name that stood there before in front of it that of its section, "sweepyaml.seed";
  they are not in the text of the sections. */
  std::vector<ManualSection> rows;
};

struct MarkdownPlaces {
  std::string name;                ///< of the page, for messages
  std::filesystem::path pictures;  ///< folder that addresses of pictures are relative to
  /** Address of a link as the page has it. @throws Error(kFormat) when there is no such page. */
  std::function<std::string(const std::string& target)> find_link;
};

/** Pictures (PNG, SVG) become part of the page. Headings of second and third order get anchors from
their words. @throws Error(kFormat) naming page and line: no title, markup, a picture that is
missing. */
ManualText ReadMarkdown(const std::string& markdown, const MarkdownPlaces& places);

}  // namespace graspbench
