#include "reports/page/layout.h"

#include <cctype>
#include <kainjow/mustache.hpp>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "reports/page/assets.h"
#include "reports/page/page_script.h"

namespace graspbench {
namespace {

// NumberParts finds what has these and no other elements.
constexpr char kFigureOpening[] = "<figure id=\"", kTableOpening[] = "<div id=\"table-";
constexpr char kFigureLabel[] = "<b class=\"nr\">Figure", kTableLabel[] = "<b class=\"nr\">Table";

Html MakeNumberLabel(const char* word) { return Element("b", {{"class", "nr"}}, word); }

/** "All cells, 95 % interval" = "all-cells-95-interval"; whole words of at most some 60 letters. */
std::string MakeSlug(std::string_view text) {
  constexpr size_t kLongest = 60;
  std::string slug;
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 0x80 && std::isalnum(letter)) {
      slug += static_cast<char>(std::tolower(letter));
    } else if (!slug.empty() && slug.back() != '-') {
      if (slug.size() > kLongest) break;
      slug += '-';
    }
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug.substr(0, 2 * kLongest);
}

}  // namespace

Table::Table(std::string caption, std::vector<Column> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void Table::AddRow(const std::vector<Html>& cells, const std::string& anchor) {
  GRASPBENCH_DEMAND(cells.size() == columns_.size(), caption_);
  Html row;
  for (size_t i = 0; i < cells.size(); ++i) {
    Attributes attributes;
    if (i == 0) attributes.push_back({"scope", "row"});
    if (columns_[i].align == Align::kNumber) attributes.push_back({"class", "number"});
    if (columns_[i].align == Align::kProse) attributes.push_back({"class", "prose"});
    row += Element(i == 0 ? "th" : "td", attributes, cells[i]);
  }
  rows_ += Element("tr", anchor.empty() ? Attributes() : Attributes{{"id", anchor}}, row);
}

namespace {

/** Whoever uses the keyboard must be able to reach what scrolls. */
Html DrawScroll(Attributes attributes, std::string_view label, const Html& content) {
  attributes.insert(attributes.end(), {{"class", "scroll"},
                                       {"role", "group"},
                                       {"aria-label", std::string(label)},
                                       {"tabindex", "0"}});
  return Element("div", attributes, content);
}

}  // namespace

Html Table::ToHtml() const {
  Html head;
  for (const Column& column : columns_) {
    Attributes attributes = {{"scope", "col"}};
    if (column.align == Align::kNumber) attributes.push_back({"class", "number"});
    if (!column.hint.empty()) attributes.push_back({"title", column.hint});
    head += Element("th", attributes, column.head);
  }
  const Html table =
      Element("table", {},
              Element("caption", {}, MakeNumberLabel("Table") + Text(" " + caption_)) +
                  Element("thead", {}, Element("tr", {}, head)) + Element("tbody", {}, rows_));
  return DrawScroll({{"id", "table-" + MakeSlug(caption_)}}, caption_, table);
}

namespace {

void AddConfigRows(const Json& config, const std::string& prefix, Table& table) {
  for (const auto& [key, value] : config.items()) {
    if (value.is_object()) {
      AddConfigRows(value, prefix + key + ".", table);
    } else {
      table.AddRow({Element("code", {}, prefix + key), Element("code", {}, FormatJson(value))});
    }
  }
}

}  // namespace

Html MakeConfigTable(const std::string& caption, const Json& config) {
  Table table(caption, {{"Key"}, {"Value", Align::kProse}});
  AddConfigRows(config, "", table);
  return table.ToHtml();
}

Html MakeScroll(std::string_view label, const Html& content) {
  return DrawScroll({}, label, content);
}

Html MakeFigure(std::string_view caption, std::string_view look_for, const Html& content) {
  const Html look =
      Element("span", {{"class", "look"}}, Element("b", {}, "What to look for: ") + Text(look_for));
  return Element("figure", {{"id", "figure-" + MakeSlug(caption)}},
                 content + Element("figcaption", {},
                                   MakeNumberLabel("Figure") + Text(" ") + Text(caption) + look));
}

Html MakeParagraph(std::string_view text) { return Element("p", {}, text); }

Html MakeNote(const char* kind, std::string_view headline, const Html& content) {
  return Element("div", {{"class", std::string("note ") + kind}, {"role", "note"}},
                 Element("p", {}, Element("strong", {}, headline)) + content);
}

Html MakeList(const std::vector<std::string>& items) {
  Html list;
  for (const std::string& item : items) list += Element("li", {}, item);
  return Element("ul", {}, list);
}

Html MakeDetails(std::string_view summary, const Html& content) {
  return Element("details", {}, Element("summary", {}, summary) + content);
}

namespace {

// What came from a file cannot be taken for it: its "<" is escaped.
constexpr char kBodyMark[] = "<!--body-->";

/** Appends the body, whose figures and tables get their numbers; an id that stands there already
gets one, too. */
void AppendNumbered(const std::string& body, std::string& numbered) {
  const std::pair<std::string_view, bool> marks[] = {
      {kFigureOpening, true}, {kTableOpening, true}, {kFigureLabel, false}, {kTableLabel, false}};
  std::map<std::string, int> counts;
  size_t done = 0;
  for (size_t at = body.find('<'); at != std::string::npos; at = body.find('<', at + 1)) {
    for (const auto& [mark, is_id] : marks) {
      if (body.compare(at, mark.size(), mark) != 0) continue;
      const size_t end = is_id ? body.find('"', at + mark.size()) : at + mark.size();
      numbered.append(body, done, end - done);
      done = end;
      const int count = ++counts[body.substr(at, end - at)];
      if (!is_id) numbered += "\u00A0" + std::to_string(count) + ".";
      if (is_id && count > 1) numbered += "-" + std::to_string(count);
    }
  }
  numbered.append(body, done, std::string::npos);
}

/** @param provenance  for machines; empty: none */
std::string RenderPage(const PlainPage& plain, const std::string& provenance) {
  // The comments make the script a part of XML, too.
  const std::string script = "//<![CDATA[\n" + std::string(assets::kScript) + "//]]>";
  kainjow::mustache::mustache page{std::string(assets::kPage)};
  kainjow::mustache::data data;
  data.set("title", Text(plain.title).markup());
  data.set("subtitle", Text(plain.subtitle).markup());
  data.set("style", std::string(assets::kStyle) + std::string(assets::kPlotStyle));
  data.set("script", script);
  data.set("script_source", FormatScriptSource(script));
  if (!provenance.empty()) data.set("provenance", provenance);
  data.set("contents", plain.navigation.markup());
  // A body of 10 MB would be copied many times: it takes its place in what is rendered without it.
  data.set("body", std::string(kBodyMark));
  std::string html = page.render(data);
  GRASPBENCH_DEMAND(page.is_valid(), page.error_message());
  const size_t at = html.find(kBodyMark);
  GRASPBENCH_DEMAND(at != std::string::npos, std::string(kBodyMark));
  const std::string end = html.substr(at + std::string_view(kBodyMark).size());
  const std::string& body = plain.body.markup();
  html.resize(at);
  html.reserve(at + body.size() + body.size() / 64 + end.size());
  AppendNumbered(body, html);
  return html += end;
}

}  // namespace

std::string MakePlainPage(const PlainPage& page) { return RenderPage(page, {}); }

std::string MakePage(const PageFrame& frame, const std::vector<PageLink>& contents, Html body) {
  constexpr char kProvenance[] = "provenance", kProvenanceTitle[] = "Versions and citation";
  Html links;
  for (const PageLink& link : contents) {
    links += Element("li", {}, LinkTo(link.anchor, link.title));
  }
  links += Element("li", {}, LinkTo(kProvenance, kProvenanceTitle));
  body += Element("section", {{"id", kProvenance}},
                  Element("h2", {}, kProvenanceTitle) + DrawProvenance(frame));
  return RenderPage({frame.title, frame.subtitle, links, std::move(body)}, MakeJsonLd(frame));
}

}  // namespace graspbench
