#pragma once
/** @file
The recurring parts of a page: tables, figures with reading hints, notes, and the page frame. */

#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "reports/page/html.h"

namespace graspbench {

/* What every page states besides its sections: how and with what it was made, and what to cite.
None of it depends on the time or the machine. */
struct PageFrame {
  std::string title;
  std::string subtitle = {};
  std::vector<std::string> commands = {};  ///< that reproduce the page
  /** Facts about the results, in addition to versions: {"Seed", "1"}. */
  std::vector<std::pair<std::string, std::string>> facts = {};
  std::vector<std::string> references =
      {};  ///< keys of the entries in assets/references.bib that the methods cite
};

/** Returns the program's BibTeX entry, then those with these keys. @pre the keys are known. */
std::string MakeBibtex(const std::vector<std::string>& keys);

/** Draws the page's last part: a table of commands, versions and facts, and BibTeX. */
Html DrawProvenance(const PageFrame& frame);

/** The provenance as JSON-LD in the vocabulary of schema.org, without characters that could end a
script. */
std::string MakeJsonLd(const PageFrame& frame);

/** Note for the subtitle of results from another or an unstated physics version: "; simulated with
physics 12, this graspbench has 13"; else empty. @param version  0: not stated. */
std::string DescribePhysics(int version);

/** Makes a framed methods text for a paper; `report --paper` extracts it from the page. */
Html MakeMethodsText(const std::vector<std::string>& paragraphs);

struct Column {
  Column(std::string its_head, std::string its_hint = {})
      : head(std::move(its_head)), hint(std::move(its_hint)) {}
  Column(const char* its_head) : head(its_head) {}

  std::string head;  ///< with the unit in brackets: "GCT [s]"
  std::string hint;  ///< explanation of the number; shown on hover
};

/** Text, an integer, or markup. */
struct Cell {
  Cell(Html its_markup)
      : text(its_markup.markup().substr(0, its_markup.markup().find('<'))),
        markup(std::move(its_markup)) {}
  Cell(std::string its_text) : text(std::move(its_text)), markup(Text(text)) {}
  Cell(const char* its_text) : Cell(std::string(its_text)) {}
  template <class Count, std::enable_if_t<std::is_integral_v<Count>, int> = 0>
  Cell(Count count) : Cell(std::to_string(count)) {}

  std::string text;  ///< before the first element
  Html markup;
};

/** A table whose first column names the row. Columns of numbers are aligned to the right; long
texts wrap. Wide tables scroll inside their frame. The id is "table-" followed by the caption in
plain letters; the page assigns the number. */
class Table {
 public:
  Table(std::string caption, std::vector<Column> columns);
  /** @param anchor  of the row, for links; empty: none. @pre as many cells as columns. */
  void AddRow(std::vector<Cell> cells, std::string anchor = {});
  Html ToHtml() const;

 private:
  struct Row {
    std::vector<Cell> cells;
    std::string anchor;
  };
  std::string caption_;
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

/** Makes a table from the rows of an analysis; headings begin with a capital letter.
@param first  by row: a link that replaces the text of the first column; empty: the text. */
Html MakeTable(const std::string& caption, const ShownTable& shown,
               const std::vector<Html>& first = {});

/** Makes a table of all values of a configuration by key ("sim.step_s"). */
Html MakeConfigTable(const std::string& caption, const Json& config);

/** Makes content that scrolls sideways in a narrow window, also by keyboard. */
Html MakeScroll(std::string_view label, const Html& content);

/** Makes a figure whose caption ends with one line on how to read it. The id is "figure-" followed
by the caption in plain letters; the page assigns the number. */
Html MakeFigure(std::string_view caption, std::string_view look_for, const Html& content);

Html MakeParagraph(std::string_view text);

/** Makes a framed note; `kind` is "warning" or "info". */
Html MakeNote(const char* kind, std::string_view headline, const Html& content);

Html MakeList(const std::vector<std::string>& items);

/** Makes a collapsed section; `summary` states how many items it holds. */
Html MakeDetails(std::string_view summary, const Html& content);

struct PageLink {
  std::string anchor;
  std::string title;
};

/** A page of text without results. */
struct PlainPage {
  std::string title;
  std::string subtitle;
  Html navigation;  ///< list items
  Html body;
};

/** Makes a page: head with a strict content security policy and an inline style sheet, skip link,
navigation, body, and the script assets/page.js, the only one that the policy allows. */
std::string MakePlainPage(const PlainPage& page);

/** Makes a page of results as MakePlainPage does, with contents, body and provenance. Numbers
figures and tables. */
std::string MakePage(const PageFrame& frame, const std::vector<PageLink>& contents, Html body);

/** The only function that writes the page of a stored result. Writes report/index.html into the
result's folder and seals it, so that `graspbench verify` detects later changes. @returns its path.
@throws Error(kIo). */
std::filesystem::path WriteReportPage(const std::filesystem::path& folder, std::string_view page);

/** A section of a page; all sections are drawn from the same data, in the order of a list. */
template <class Data>
struct PageSection {
  const char* anchor;  ///< lower-case letters only, so that it equals no other anchor
  const char* title;
  Html (*draw)(const Data& data);  ///< must accept empty data; an empty result is left out
};

template <class Data>
std::string MakeSectionedPage(const PageFrame& frame,
                              const std::vector<PageSection<Data>>& sections, const Data& data) {
  std::vector<PageLink> contents;
  Html body;
  for (const PageSection<Data>& section : sections) {
    const Html content = section.draw(data);
    if (content.empty()) continue;
    contents.push_back({section.anchor, section.title});
    body +=
        Element("section", {{"id", section.anchor}}, Element("h2", {}, section.title) + content);
  }
  return MakePage(frame, contents, std::move(body));
}

template <class Data>
std::string MakeSectionedPage(const std::string& title, const std::string& subtitle,
                              const std::vector<PageSection<Data>>& sections, const Data& data) {
  return MakeSectionedPage(PageFrame{title, subtitle}, sections, data);
}

// Pages with a script of their own in addition to the common one.
/** Formats a script's hash for a content security policy: 'sha256-...'. */
std::string FormatScriptSource(const std::string& script);

/** Adds a style sheet to the page of MakePage or MakePlainPage. */
std::string AddStyle(std::string page, const std::string& style);

/** Style and script of a page; part of the program, never from a file. */
struct PageScript {
  std::string style;   ///< sheet
  std::string script;  ///< contains neither "</script" nor "]]>"
};

/** Adds style and script to the page of MakePage. The content security policy then allows this
script, by its hash, and nothing else in addition. Without a script the page is unchanged. */
std::string AddScript(std::string page, const PageScript& added);

}  // namespace graspbench
