#include "reports/page/layout.h"

#include <algorithm>
#include <cctype>
#include <kainjow/mustache.hpp>
#include <map>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json.h"
#include "core/base/version.h"
#include "core/physics/sim_config.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/ro_crate.h"
#include "reports/page/assets.h"
#include "reports/page/html.h"

namespace graspbench {

namespace {

void InsertAt(std::string& page, size_t at, std::string_view what, const std::string& text) {
  GRASPBENCH_DEMAND(at != std::string::npos, std::string(what) + " is not in the page");
  page.insert(at, text);
}

}  // namespace

std::string FormatScriptSource(const std::string& script) {
  const std::string digest = CalcSha256(script);
  std::string bytes;
  for (size_t i = 0; i < digest.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(digest.substr(i, 2), nullptr, 16));
  }
  return "'sha256-" + EncodeBase64(bytes) + "'";
}

std::string AddStyle(std::string page, const std::string& style) {
  constexpr std::string_view kHeadEnd = "</head>";
  InsertAt(page, page.find(kHeadEnd), kHeadEnd, "<style>\n" + style + "</style>\n");
  return page;
}

std::string AddScript(std::string page, const PageScript& added) {
  constexpr std::string_view kHeadEnd = "</head>", kBodyEnd = "</body>",
                             kPolicy = "default-src 'none'; ", kScripts = "script-src ";
  if (added.script.empty()) return page;
  page = AddStyle(std::move(page), added.style);
  GRASPBENCH_DEMAND(added.script.find("</script") == std::string::npos &&
                        added.script.find("]]>") == std::string::npos,
                    "the script of the page");
  // The comments let XML parsers read the script as text, too.
  const std::string script = "//<![CDATA[\n" + added.script + "\n//]]>\n";
  InsertAt(page, page.rfind(kBodyEnd), kBodyEnd, "<script>" + script + "</script>\n");
  const size_t head_end = page.find(kHeadEnd);
  const size_t scripts = page.find(kScripts), policy = page.find(kPolicy);
  if (scripts < head_end) {
    page.insert(scripts + kScripts.size(), FormatScriptSource(script) + " ");
  } else {
    GRASPBENCH_DEMAND(policy < head_end, std::string(kPolicy));
    page.insert(policy + kPolicy.size(), std::string(kScripts) + FormatScriptSource(script) + "; ");
  }
  return page;
}

namespace {

/** Lists the files that the page shows; empty means the whole store. Of the experiments on a
session's draws the page shows only the sensitivity, which may run later. */
std::vector<std::string> ListShown(const std::filesystem::path& folder) {
  if (FindStoreKind(folder) != &kSessionStore) return {};
  std::vector<std::string> shown = kSessionStore.files;
  shown.insert(shown.end(), kSessionStore.journals.begin(), kSessionStore.journals.end());
  shown.push_back("sensitivity/*");
  return shown;
}

}  // namespace

std::filesystem::path WriteReportPage(const std::filesystem::path& folder, std::string_view page) {
  const std::filesystem::path report = folder / "report", path = report / "index.html";
  MakeFolder(report);
  UnsealOutput(report);
  WriteFileAtomically(path, page);
  SealOutput(report, {"index.html"},
             MakeOutputOrigin(folder, "graspbench report .", ListShown(folder)));
  return path;
}

namespace {

std::vector<std::pair<std::string, std::string>> ListFacts(const PageFrame& frame) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"graspbench, which made this page", program_version()},
      {"Physics of this graspbench", std::to_string(kPhysicsVersion)},
      {"Libraries of this graspbench", std::string(assets::kLibraries)}};
  facts.insert(facts.end(), frame.facts.begin(), frame.facts.end());
  return facts;
}

/** Returns the BibTeX entry with this key, including its closing brace. */
std::string FindReference(const std::string& key) {
  const std::string_view all = assets::kReferences;
  const size_t name = all.find("{" + key + ",");
  GRASPBENCH_DEMAND(name != std::string_view::npos, key);
  const size_t begin = all.rfind('@', name);
  const size_t end = all.find("\n}\n", name);
  return std::string(all.substr(begin, end + 3 - begin));
}

}  // namespace

std::string MakeBibtex(const std::vector<std::string>& keys) {
  std::string text =
      "@software{graspbench,\n  author  = {{The graspbench developers}},\n"
      "  title   = {graspbench: a workbench for grasping experiments},\n  version = {" +
      std::string(program_version()) + "},\n  year    = {" + std::string(assets::kReleaseYear) +
      "},\n  note    = {commit " + program_commit() + "}\n}\n";
  for (const std::string& key : keys) text += "\n" + FindReference(key);
  return text;
}

Html DrawProvenance(const PageFrame& frame) {
  Html html;
  if (!frame.commands.empty()) {
    std::string lines;
    for (const std::string& command : frame.commands) lines += command + "\n";
    html += MakeParagraph("Made by") + MakeScroll("Commands", Element("pre", {}, lines));
  }
  Table table("Versions and provenance.", {"What", "Value"});
  for (const auto& [what, value] : ListFacts(frame)) table.AddRow({what, value});
  return html + table.ToHtml() +
         MakeDetails("BibTeX of what to cite",
                     MakeScroll("BibTeX", Element("pre", {{"class", "bibtex"}},
                                                  MakeBibtex(frame.references))));
}

std::string MakeJsonLd(const PageFrame& frame) {
  Json facts = Json::array();
  for (const auto& [what, value] : ListFacts(frame)) {
    facts.push_back({{"@type", "PropertyValue"}, {"name", what}, {"value", value}});
  }
  const Json json = {{"@context", "https://schema.org"},
                     {"@type", "Dataset"},
                     {"name", frame.title},
                     {"description", frame.subtitle},
                     {"creator",
                      {{"@type", "SoftwareApplication"},
                       {"name", "graspbench"},
                       {"softwareVersion", program_version()},
                       {"softwareRequirements", assets::kLibraries}}},
                     {"measurementTechnique", frame.commands},
                     {"additionalProperty", facts}};
  std::string safe;
  for (const char c : FormatJson(json)) {
    if (c == '<') {
      safe += "\\u003c";
    } else if (c == '>') {
      safe += "\\u003e";
    } else if (c == '&') {
      safe += "\\u0026";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string DescribePhysics(int version) {
  if (version == kPhysicsVersion) return "";
  return "; simulated with " +
         (version == 0 ? "an unnamed physics version" : "physics " + std::to_string(version)) +
         ", this graspbench has " + std::to_string(kPhysicsVersion);
}

Html MakeMethodsText(const std::vector<std::string>& paragraphs) {
  Html text;
  for (const std::string& paragraph : paragraphs) text += MakeParagraph(paragraph);
  return MakeParagraph("Ready to paste:") + Element("blockquote", {{"class", "methods"}}, text);
}

namespace {

// AppendNumbered recognises figures and tables by these openings, which no other elements have.
constexpr char kFigureOpening[] = "<figure id=\"", kTableOpening[] = "<div id=\"table-";
constexpr char kFigureLabel[] = "<b class=\"nr\">Figure", kTableLabel[] = "<b class=\"nr\">Table";

Html MakeNumberLabel(const char* word) { return Element("b", {{"class", "nr"}}, word); }

/** Makes a slug: "All cells, 95 % interval" becomes "all-cells-95-interval". It keeps whole words
up to some 60 letters. */
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

/** Recognises numbers such as "12.5", "6 of 10", "-0.4 (-1.2 to 0.3)", "x 1.41", "F = 1.91" and "3
ms", and placeholders for missing numbers. "1 lost while closing" is not a number because its words
are longer than units. */
bool IsNumber(const std::string& text) {
  constexpr size_t kLongest = 40, kLongestUnit = 3;
  if (text.empty() || text == "-" || text == "n/a" || text == "none held") return true;
  const size_t name = text.find("= ");
  const std::string value = name == std::string::npos ? text : text.substr(name + 2);
  const size_t start = value.find_first_not_of("+-<x ");
  size_t word = 0, longest_word = 0;
  for (const char c : value) {
    word = std::isalpha(static_cast<unsigned char>(c)) ? word + 1 : 0;
    longest_word = std::max(longest_word, word);
  }
  return text.size() <= kLongest && longest_word <= kLongestUnit && start < 3 &&
         value[start] >= '0' && value[start] <= '9';
}

/** Wraps content in a scrollable group that can be reached with the keyboard. */
Html DrawScroll(Attributes attributes, std::string_view label, const Html& content) {
  attributes.insert(attributes.end(), {{"class", "scroll"},
                                       {"role", "group"},
                                       {"aria-label", std::string(label)},
                                       {"tabindex", "0"}});
  return Element("div", attributes, content);
}

}  // namespace

Table::Table(std::string caption, std::vector<Column> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void Table::AddRow(std::vector<Cell> cells, std::string anchor) {
  GRASPBENCH_DEMAND(cells.size() == columns_.size(), caption_);
  rows_.push_back({std::move(cells), std::move(anchor)});
}

Html Table::ToHtml() const {
  constexpr size_t kLongText = 40;
  Html head, body;
  std::vector<const char*> classes(columns_.size(), "number");
  for (size_t i = 0; i < columns_.size(); ++i) {
    size_t longest = 0;
    bool is_number = i > 0, is_empty = true;
    for (const Row& row : rows_) {
      const Cell& cell = row.cells[i];
      longest = std::max(longest, cell.text.size());
      is_number = is_number && IsNumber(cell.text) && (!cell.text.empty() || cell.markup.empty());
      is_empty = is_empty && cell.text.empty();
    }
    if (!is_number || is_empty) classes[i] = longest > kLongText ? "prose" : "";
    Attributes attributes = {{"scope", "col"}};
    if (classes[i] == std::string_view("number")) attributes.push_back({"class", "number"});
    if (!columns_[i].hint.empty()) attributes.push_back({"title", columns_[i].hint});
    head += Element("th", attributes, columns_[i].head);
  }
  for (const auto& [cells, anchor] : rows_) {
    Html row;
    for (size_t i = 0; i < cells.size(); ++i) {
      Attributes attributes;
      if (i == 0) attributes.push_back({"scope", "row"});
      if (*classes[i]) attributes.push_back({"class", classes[i]});
      row += Element(i == 0 ? "th" : "td", attributes, cells[i].markup);
    }
    body += Element("tr", anchor.empty() ? Attributes() : Attributes{{"id", anchor}}, row);
  }
  const Html table =
      Element("table", {},
              Element("caption", {}, MakeNumberLabel("Table") + Text(" " + caption_)) +
                  Element("thead", {}, Element("tr", {}, head)) + Element("tbody", {}, body));
  return DrawScroll({{"id", "table-" + MakeSlug(caption_)}}, caption_, table);
}

Html MakeTable(const std::string& caption, const ShownTable& shown,
               const std::vector<Html>& first) {
  std::vector<Column> columns;
  for (const ShownTable::Column& column : shown.columns) {
    std::string head = column.heading;
    const auto is_lower = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
    if (head.size() > 2 && std::all_of(head.begin(), head.begin() + 3, is_lower)) {
      head[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(head[0])));
    }
    columns.emplace_back(head, column.hint);
  }
  Table table(caption, columns);
  for (size_t row = 0; row < shown.num_rows; ++row) {
    std::vector<Cell> cells;
    for (const ShownTable::Column& column : shown.columns) cells.emplace_back(column.cells[row]);
    if (!first.empty()) cells.front() = first[row];
    table.AddRow(std::move(cells));
  }
  return table.ToHtml();
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
  Table table(caption, {"Key", "Value"});
  AddConfigRows(config, "", table);
  return table.ToHtml();
}

Html MakeScroll(std::string_view label, const Html& content) {
  return DrawScroll({}, label, content);
}

Html MakeFigure(std::string_view caption, std::string_view look_for, const Html& content) {
  const Html look = look_for.empty()
                        ? Html()
                        : Element("span", {{"class", "look"}},
                                  Element("b", {}, "What to look for: ") + Text(look_for));
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

// Text from a file cannot be mistaken for this mark, because its "<" is escaped.
constexpr char kBodyMark[] = "<!--body-->";

/** The last number of figures or tables. What is folded has a second number: "5.1". */
struct LastNumber {
  int shown = 0, folded = 0;

  std::string Next(bool is_folded) {
    if (is_folded) return std::to_string(shown) + "." + std::to_string(++folded);
    folded = 0;
    return std::to_string(++shown);
  }
};

/** Keeps the list of the open <details> around a place, true: folded. */
void FollowDetails(const std::string& body, size_t at, std::vector<bool>& details) {
  constexpr std::string_view kOpening = "<details", kClosing = "</details>";
  if (body.compare(at, kOpening.size(), kOpening) == 0) {
    details.push_back(body.substr(at, body.find('>', at) - at).find(" open") == std::string::npos);
  } else if (!details.empty() && body.compare(at, kClosing.size(), kClosing) == 0) {
    details.pop_back();
  }
}

/** Appends the body and numbers its figures, tables and repeated ids. */
void AppendNumbered(const std::string& body, std::string& numbered) {
  const std::pair<std::string_view, bool> marks[] = {
      {kFigureOpening, true}, {kTableOpening, true}, {kFigureLabel, false}, {kTableLabel, false}};
  std::map<std::string, int> ids;
  std::map<std::string_view, LastNumber> labels;
  std::vector<bool> details;
  size_t done = 0;
  for (size_t at = body.find('<'); at != std::string::npos; at = body.find('<', at + 1)) {
    FollowDetails(body, at, details);
    for (const auto& [mark, is_id] : marks) {
      if (body.compare(at, mark.size(), mark) != 0) continue;
      const size_t end = is_id ? body.find('"', at + mark.size()) : at + mark.size();
      numbered.append(body, done, end - done);
      done = end;
      if (is_id) {
        const int count = ++ids[body.substr(at, end - at)];
        if (count > 1) numbered += "-" + std::to_string(count);
      } else {
        const bool is_folded = std::find(details.begin(), details.end(), true) != details.end();
        numbered += "\u00A0" + labels[mark].Next(is_folded) + ".";
      }
    }
  }
  numbered.append(body, done, std::string::npos);
}

/** @param provenance machine-readable; empty if there is none */
std::string RenderPage(const PlainPage& plain, const std::string& provenance) {
  // The comments make the script valid in XML, too.
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
  // Rendering would copy a body of 10 MB many times, so it replaces a mark afterwards.
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
