#pragma once
/** @file
The page's recurring parts: tables, figures with what to look for, notes, and the frame around
everything. */

#include <string>
#include <string_view>
#include <vector>

#include "core/base/text/json.h"
#include "reports/page/html.h"
#include "reports/page/provenance.h"

namespace graspbench {

/** Prose may wrap, text and numbers stay on one line. */
enum class Align { kText, kNumber, kProse };

struct Column {
  std::string head;  ///< with the unit in brackets: "GCT [s]"
  Align align = Align::kText;
  std::string hint = {};  ///< what the number is; shown when pointed at
};

/** A table whose first column names its row. Wide tables scroll inside their frame. Its id is
"table-" and its caption in plain letters, its number that of the page. */
class Table {
 public:
  Table(std::string caption, std::vector<Column> columns);
  /** @param anchor  of the row, for links; empty: none. @pre as many cells as columns */
  void AddRow(const std::vector<Html>& cells, const std::string& anchor = {});
  Html ToHtml() const;

 private:
  std::string caption_;
  std::vector<Column> columns_;
  Html rows_;
};

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

}  // namespace graspbench
