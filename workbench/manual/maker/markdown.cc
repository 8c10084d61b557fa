#include "workbench/manual/maker/markdown.h"

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>

#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <string_view>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

std::string GetLiteral(cmark_node* node) {
  const char* text = cmark_node_get_literal(node);
  return text ? text : "";
}

/** "Grip: force or margin" = "grip-force-or-margin", as GitHub makes it of plain words. */
std::string MakeAnchor(std::string_view title) {
  std::string anchor;
  for (const char c : title) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter)) {
      anchor += static_cast<char>(std::tolower(letter));
    } else if ((c == ' ' || c == '-') && !anchor.empty()) {
      anchor += '-';
    }
  }
  return anchor;
}

/** The words of a node and what is in it. */
std::string CollectText(cmark_node* node) {
  std::string text;
  const std::unique_ptr<cmark_iter, void (*)(cmark_iter*)> iterator(cmark_iter_new(node),
                                                                    &cmark_iter_free);
  for (cmark_event_type event; (event = cmark_iter_next(iterator.get())) != CMARK_EVENT_DONE;) {
    cmark_node* each = cmark_iter_get_node(iterator.get());
    if (event != CMARK_EVENT_ENTER) continue;
    const cmark_node_type type = cmark_node_get_type(each);
    if (type == CMARK_NODE_SOFTBREAK || type == CMARK_NODE_LINEBREAK) text += " ";
    if (std::string_view(cmark_node_get_type_string(each)) == "table_cell") text += " ";
    text += GetLiteral(each);
  }
  return text;
}

class MarkdownReader {
 public:
  explicit MarkdownReader(const MarkdownPlaces& places) : places_(places) {}

  ManualText Read(cmark_node* document) {
    ManualText page;
    cmark_node* node = cmark_node_first_child(document);
    if (!node || cmark_node_get_heading_level(node) != 1) {
      Refuse(document, "a page begins with its title: # Title");
    }
    page.title = CollectText(node);
    node = cmark_node_next(node);
    if (node && cmark_node_get_type(node) == CMARK_NODE_PARAGRAPH) {
      page.subtitle = CollectText(node);
      node = cmark_node_next(node);
    }
    page.sections.push_back({"", page.title, page.subtitle});
    for (; node; node = cmark_node_next(node)) {
      if (cmark_node_get_type(node) == CMARK_NODE_HEADING) {
        page.sections.push_back({MakeAnchor(CollectText(node)), CollectText(node), ""});
        names_.insert(page.sections.back().anchor);
      } else if (!IsTable(node) || !NameRows(node, page)) {
        page.sections.back().text += " " + CollectText(node);
      }
      page.body += DrawBlock(node);
    }
    return page;
  }

 private:
  static bool IsTable(cmark_node* node) {
    return std::string_view(cmark_node_get_type_string(node)) == "table";
  }

  /** False: no row of the table begins with one word in code. */
  bool NameRows(cmark_node* table, ManualText& page) {
    const ManualSection& section = page.sections.back();
    const size_t before = page.rows.size();
    for (cmark_node* row = cmark_node_first_child(table); row; row = cmark_node_next(row)) {
      cmark_node* word = cmark_node_first_child(cmark_node_first_child(row));
      if (!word || cmark_node_next(word) || cmark_node_get_type(word) != CMARK_NODE_CODE) continue;
      const std::string name = GetLiteral(word);
      if (name.find(' ') != name.npos) continue;
      std::string anchor = name;
      if (!names_.insert(anchor).second) anchor = section.anchor + "." + name;
      page.rows.push_back({anchor, name, section.title + CollectText(row)});
      anchors_[row] = anchor;
    }
    return page.rows.size() > before;
  }

  [[noreturn]] void Refuse(cmark_node* node, const std::string& what) const {
    throw Error(ErrorKind::kFormat,
                places_.name + ":" + std::to_string(cmark_node_get_start_line(node)) + ": " + what);
  }

  Html DrawChildren(cmark_node* node, Html (MarkdownReader::*draw)(cmark_node*) const) const {
    Html html;
    for (cmark_node* each = cmark_node_first_child(node); each; each = cmark_node_next(each)) {
      html += (this->*draw)(each);
    }
    return html;
  }
  Html DrawBlocks(cmark_node* node) const { return DrawChildren(node, &MarkdownReader::DrawBlock); }
  Html DrawInlines(cmark_node* node) const {
    return DrawChildren(node, &MarkdownReader::DrawInline);
  }

  /** Lines that a person types are set apart from what the program answers. */
  static Html DrawConsole(const std::string& text) {
    Html html;
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
      const std::string line = text.substr(begin, end - begin);
      html += line.rfind("$ ", 0) == 0 ? Element("b", {}, line) : Text(line);
      begin = end;
    }
    return html;
  }

  Html DrawCode(cmark_node* node) const {
    const std::string language = cmark_node_get_fence_info(node);
    const std::string text = GetLiteral(node);
    return MakeScroll(language == "console" ? "Commands and what they print" : "Text",
                      Element("pre", {{"class", language}},
                              language == "console" ? DrawConsole(text) : Text(text)));
  }

  Html DrawItem(cmark_node* item) const {
    // Of a tight list, the text stands without paragraphs.
    const bool tight = cmark_node_get_list_tight(cmark_node_parent(item)) != 0;
    Html html;
    for (cmark_node* each = cmark_node_first_child(item); each; each = cmark_node_next(each)) {
      const bool bare = tight && cmark_node_get_type(each) == CMARK_NODE_PARAGRAPH;
      html += bare ? DrawInlines(each) : DrawBlock(each);
    }
    return Element("li", {}, html);
  }

  Html DrawTable(cmark_node* table) const {
    Html head, body;
    for (cmark_node* row = cmark_node_first_child(table); row; row = cmark_node_next(row)) {
      const bool is_head = std::string_view(cmark_node_get_type_string(row)) == "table_header";
      Html cells;
      for (cmark_node* cell = cmark_node_first_child(row); cell; cell = cmark_node_next(cell)) {
        cells += is_head ? Element("th", {{"scope", "col"}}, DrawInlines(cell))
                         : Element("td", {{"class", "prose"}}, DrawInlines(cell));
      }
      const auto anchor = anchors_.find(row);
      const Attributes id =
          anchor == anchors_.end() ? Attributes() : Attributes{{"id", anchor->second}};
      (is_head ? head : body) += Element("tr", id, cells);
    }
    return MakeScroll(
        "Table", Element("table", {}, Element("thead", {}, head) + Element("tbody", {}, body)));
  }

  Html DrawBlock(cmark_node* node) const {
    switch (cmark_node_get_type(node)) {
      case CMARK_NODE_PARAGRAPH:
        return Element("p", {}, DrawInlines(node));
      case CMARK_NODE_HEADING: {
        const int level = cmark_node_get_heading_level(node);
        if (level == 1 || level > 3) Refuse(node, "headings are of second or third order");
        return Element(level == 2 ? "h2" : "h3", {{"id", MakeAnchor(CollectText(node))}},
                       DrawInlines(node));
      }
      case CMARK_NODE_CODE_BLOCK:
        return DrawCode(node);
      case CMARK_NODE_BLOCK_QUOTE:
        return Element("blockquote", {}, DrawBlocks(node));
      case CMARK_NODE_LIST:
        return Element(cmark_node_get_list_type(node) == CMARK_ORDERED_LIST ? "ol" : "ul", {},
                       DrawChildren(node, &MarkdownReader::DrawItem));
      default:
        break;
    }
    if (IsTable(node)) return DrawTable(node);
    Refuse(node, std::string("no place for ") + cmark_node_get_type_string(node));
  }

  Html DrawPicture(cmark_node* node) const {
    const std::filesystem::path file = places_.pictures / cmark_node_get_url(node);
    if (!std::filesystem::is_regular_file(file)) {
      Refuse(node, "no picture " + file.filename().string());
    }
    const char* type = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
    return Element("img", {{"src", MakeDataUri(type, ReadFile(file))}, {"alt", CollectText(node)}});
  }

  Html DrawLink(cmark_node* node) const {
    const std::string target = cmark_node_get_url(node);
    if (target.find("://") != std::string::npos) {
      return Element("a", {{"href", target}}, DrawInlines(node));
    }
    try {
      return Element("a", {{"href", places_.find_link(target)}}, DrawInlines(node));
    } catch (const Error& error) {
      Refuse(cmark_node_parent(node), error.what());
    }
  }

  Html DrawInline(cmark_node* node) const {
    switch (cmark_node_get_type(node)) {
      case CMARK_NODE_TEXT:
        return Text(GetLiteral(node));
      case CMARK_NODE_SOFTBREAK:
        return Text("\n");
      case CMARK_NODE_LINEBREAK:
        return Element("br", {});
      case CMARK_NODE_CODE:
        return Element("code", {}, GetLiteral(node));
      case CMARK_NODE_EMPH:
        return Element("em", {}, DrawInlines(node));
      case CMARK_NODE_STRONG:
        return Element("strong", {}, DrawInlines(node));
      case CMARK_NODE_LINK:
        return DrawLink(node);
      case CMARK_NODE_IMAGE:
        return DrawPicture(node);
      default:
        Refuse(cmark_node_parent(node),
               std::string("no place for ") + cmark_node_get_type_string(node));
    }
  }

  const MarkdownPlaces& places_;
  std::set<std::string> names_;                 ///< anchors of headings and rows
  std::map<cmark_node*, std::string> anchors_;  ///< of rows
};

}  // namespace

ManualText ReadMarkdown(const std::string& markdown, const MarkdownPlaces& places) {
  cmark_gfm_core_extensions_ensure_registered();
  const std::unique_ptr<cmark_parser, void (*)(cmark_parser*)> parser(
      cmark_parser_new(CMARK_OPT_VALIDATE_UTF8), &cmark_parser_free);
  cmark_parser_attach_syntax_extension(parser.get(), cmark_find_syntax_extension("table"));
  cmark_parser_feed(parser.get(), markdown.data(), markdown.size());
  const std::unique_ptr<cmark_node, void (*)(cmark_node*)> document(
      cmark_parser_finish(parser.get()), &cmark_node_free);
  return MarkdownReader(places).Read(document.get());
}

}  // namespace graspbench
