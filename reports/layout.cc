#include "reports/layout.h"

#include <kainjow/mustache.hpp>
#include <utility>

#include "core/base/error.h"
#include "reports/assets.h"

namespace graspbench {

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
              Element("caption", {}, caption_) + Element("thead", {}, Element("tr", {}, head)) +
                  Element("tbody", {}, rows_));
  return MakeScroll(caption_, table);
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
  // Whoever uses the keyboard must be able to reach what scrolls.
  return Element("div",
                 {{"class", "scroll"},
                  {"role", "region"},
                  {"aria-label", std::string(label)},
                  {"tabindex", "0"}},
                 content);
}

Html MakeFigure(std::string_view caption, std::string_view look_for, const Html& content) {
  return Element("figure", {},
                 content + Element("figcaption", {},
                                   Text(caption) + Element("span", {{"class", "look"}},
                                                           Element("b", {}, "What to look for: ") +
                                                               Text(look_for))));
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

std::string MakePage(std::string_view title, std::string_view subtitle,
                     const std::vector<PageLink>& contents, const Html& body) {
  Html links;
  for (const PageLink& link : contents) {
    links += Element("li", {}, LinkTo(link.anchor, link.title));
  }
  kainjow::mustache::mustache page{std::string(assets::kPage)};
  kainjow::mustache::data data;
  data.set("title", Text(title).markup());
  data.set("subtitle", Text(subtitle).markup());
  data.set("style", std::string(assets::kStyle));
  data.set("contents", links.markup());
  data.set("body", body.markup());
  std::string html = page.render(data);
  GRASPBENCH_DEMAND(page.is_valid(), page.error_message());
  return html;
}

}  // namespace graspbench
