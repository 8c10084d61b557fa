#pragma once
/** @file
The page's recurring parts: tables, figures with what to look for, notes, and the frame around
everything. */

#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "reports/page/html.h"

namespace graspbench {

/* What every page says of itself beside its sections: how it was made, with what, and whom to cite.
Nothing of it depends on when or where the page was made. */
struct PageFrame {
  std::string title;
  std::string subtitle = {};
  std::vector<std::string> commands = {};  ///< that give the same page again
  /** Of the results, beside the versions: {"Seed", "1"}. */
  std::vector<std::pair<std::string, std::string>> facts = {};
  std::vector<std::string> references =
      {};  ///< keys of assets/references.bib that the methods rest on
};

/** The entries with these keys, after that of the program. @pre known keys. */
std::string MakeBibtex(const std::vector<std::string>& keys);

/** The page's last part: commands, versions and facts as a table, BibTeX. */
Html DrawProvenance(const PageFrame& frame);

/** The same for machines, in the words of schema.org, without characters that end a script. */
std::string MakeJsonLd(const PageFrame& frame);

/** Of results by another physics, or by one that their folder does not name, for a subtitle: ";
simulated with physics 12, this graspbench has 13"; else empty. @param version  0: not named. */
std::string DescribePhysics(int version);

/** A framed text for a paper; `report --paper` takes it from the page. */
Html MakeMethodsText(const std::vector<std::string>& paragraphs);

struct Column {
  Column(std::string its_head, std::string its_hint = {})
      : head(std::move(its_head)), hint(std::move(its_hint)) {}
  Column(const char* its_head) : head(its_head) {}

  std::string head;  ///< with the unit in brackets: "GCT [s]"
  std::string hint;  ///< what the number is; shown when pointed at
};

/** Text, a whole number, or markup. */
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

/** A table whose first column names its row. Columns of numbers are aligned to the right, long texts
wrap. Wide tables scroll inside their frame. Its id is "table-" and its caption in plain letters, its
number that of the page. */
class Table {
 public:
  Table(std::string caption, std::vector<Column> columns);
  /** @param anchor  of the row, for links; empty: none. @pre as many cells as columns */
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

/** The rows of an analysis; headings begin with a capital letter.
@param first  of each row, instead of the first column's text: a link; empty: the text. */
Html MakeTable(const std::string& caption, const ShownTable& shown,
               const std::vector<Html>& first = {});

/** Every value of a configuration under its key, "sim.step_s". */
Html MakeConfigTable(const std::string& caption, const Json& config);

/** Content that scrolls sideways where the window is narrow, within reach of the keyboard. */
Html MakeScroll(std::string_view label, const Html& content);

/** A figure whose caption ends with one line on how to read it. Its id is "figure-" and its caption
in plain letters, its number that of the page. */
Html MakeFigure(std::string_view caption, std::string_view look_for, const Html& content);

Html MakeParagraph(std::string_view text);

/** A framed note: `kind` is "warning" or "info". */
Html MakeNote(const char* kind, std::string_view headline, const Html& content);

Html MakeList(const std::vector<std::string>& items);

/** Something to open, with the number of what is in it in `summary`. */
Html MakeDetails(std::string_view summary, const Html& content);

struct PageLink {
  std::string anchor;
  std::string title;
};

/** A page of text, which shows no results. */
struct PlainPage {
  std::string title;
  std::string subtitle;
  Html navigation;  ///< items of a list
  Html body;
};

/** Head with a strict content security policy and the style sheet inside, skip link, navigation,
body, and the script of assets/page.js, the only one that the policy allows. */
std::string MakePlainPage(const PlainPage& page);

/** A page of results, as MakePlainPage: contents, body, provenance. Figures and tables are numbered
here. */
std::string MakePage(const PageFrame& frame, const std::vector<PageLink>& contents, Html body);

/** The one place where the page of a stored result is written.
Writes report/index.html in the result's folder and seals it, so that `graspbench verify`
notices when it is not what was written. @returns its path. @throws Error(kIo). */
std::filesystem::path WriteReportPage(const std::filesystem::path& folder, std::string_view page);

/** Pages made of sections: a list in the order of the page, each drawn from the same data. */
template <class Data>
struct PageSection {
  const char* anchor;  ///< lower-case letters only, so that it never meets another anchor
  const char* title;
  Html (*draw)(const Data& data);  ///< must bear empty data; empty: the page leaves it out
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

// A page that runs a script of its own beside what every page has.
/** A script as a page's content security policy names it: 'sha256-...'. */
std::string FormatScriptSource(const std::string& script);

/** The page of MakePage or MakePlainPage with a style sheet of its own. */
std::string AddStyle(std::string page, const std::string& style);

/** Both are ours, never from a file. */
struct PageScript {
  std::string style;   ///< sheet
  std::string script;  ///< neither "</script" nor "]]>" is in it
};

/** The page of MakePage with style and script: the content security policy lets this script run, by
its hash, and nothing else of what it forbade. Without a script the page as it is. */
std::string AddScript(std::string page, const PageScript& added);

}  // namespace graspbench
