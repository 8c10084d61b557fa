#include "reports/page/paper.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <cstring>
#include <functional>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "reports/page/assets.h"

namespace graspbench {
namespace {

using tinyxml2::XMLElement;

bool HasTag(const XMLElement& element, const char* tag) {
  return std::strcmp(element.Name(), tag) == 0;
}

std::string AttributeOf(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

/** Calls `take` for the element and all its descendants in document order. */
void ForEachElement(const XMLElement& root, const std::function<void(const XMLElement&)>& take) {
  take(root);
  for (const auto* child = root.FirstChildElement(); child; child = child->NextSiblingElement()) {
    ForEachElement(*child, take);
  }
}

const XMLElement* FindBelow(const XMLElement& root, const char* tag, const char* css_class) {
  const XMLElement* found = nullptr;
  ForEachElement(root, [&](const XMLElement& element) {
    if (found == nullptr && HasTag(element, tag) &&
        (*css_class == '\0' || AttributeOf(element, "class") == css_class)) {
      found = &element;
    }
  });
  return found;
}

/** Returns the text without the part of a caption that says what to look for. */
std::string TextBelow(const tinyxml2::XMLNode& node) {
  if (const auto* text = node.ToText()) return text->Value();
  if (node.ToElement() && AttributeOf(*node.ToElement(), "class") == "look") return {};
  std::string all;
  for (const auto* child = node.FirstChild(); child; child = child->NextSibling()) {
    all += TextBelow(*child);
  }
  return all;
}

/** Value of a style.css variable in the light theme, which comes first in the file. */
std::string FindColour(const std::string& variable) {
  const std::string_view style = assets::kStyle;
  const std::string start = "  " + variable + ": ";
  const size_t at = style.find(start);
  GRASPBENCH_DEMAND(at != std::string_view::npos, variable);
  const size_t begin = at + start.size();
  return std::string(style.substr(begin, style.find(';', begin) - begin));
}

/** The rules of plot.css with variables replaced by values, which few SVG programs support. */
std::string MakePlotStyle() {
  const std::string_view rules = assets::kPlotStyle;
  std::string style = ".plot { font-family: sans-serif; }\n";
  size_t done = 0;
  constexpr std::string_view kVariable = "var(", kCentred = " dominant-baseline: central;";
  for (size_t at = rules.find(kVariable); at != std::string_view::npos;
       at = rules.find(kVariable, done)) {
    const size_t end = rules.find(')', at);
    style += rules.substr(done, at - done);
    style +=
        FindColour(std::string(rules.substr(at + kVariable.size(), end - at - kVariable.size())));
    done = end + 1;
  }
  style += rules.substr(done);
  const size_t centred = style.find(kCentred);  // each text carries the shift itself, see
                                                // FormatPlot
  if (centred != std::string::npos) style.erase(centred, kCentred.size());
  return style;
}

/** Centres texts about y by a shift that every program supports, and turns links into groups. */
void MakeSelfContained(XMLElement& element) {
  if (HasTag(element, "text")) element.SetAttribute("dy", "0.35em");
  if (HasTag(element, "a")) {
    element.SetName("g");
    element.DeleteAttribute("href");
  }
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    MakeSelfContained(*child);
  }
}

std::string FormatPlot(const XMLElement& plot, const std::string& style) {
  tinyxml2::XMLDocument document;
  XMLElement* copy = plot.DeepClone(&document)->ToElement();
  document.InsertEndChild(copy);
  copy->SetAttribute("xmlns", "http://www.w3.org/2000/svg");
  MakeSelfContained(*copy);
  XMLElement* rules = document.NewElement("style");
  rules->SetText(style.c_str());
  copy->InsertFirstChild(rules);
  tinyxml2::XMLPrinter printer(nullptr, /*compact=*/true);
  document.Print(&printer);
  return std::string(printer.CStr()) + "\n";
}

std::string FormatTable(const XMLElement& table) {
  std::string lines;
  ForEachElement(table, [&](const XMLElement& row) {
    if (!HasTag(row, "tr")) return;
    std::vector<Json> cells;
    for (const auto* cell = row.FirstChildElement(); cell; cell = cell->NextSiblingElement()) {
      cells.push_back(TextBelow(*cell));
    }
    lines += FormatCsvLine(cells);
  });
  return lines;
}

std::string EscapeLatex(const std::string& text) {
  static const std::map<char, const char*> escapes = {{'&', "\\&"},
                                                      {'%', "\\%"},
                                                      {'$', "\\$"},
                                                      {'#', "\\#"},
                                                      {'_', "\\_"},
                                                      {'{', "\\{"},
                                                      {'}', "\\}"},
                                                      {'~', "\\textasciitilde{}"},
                                                      {'^', "\\textasciicircum{}"},
                                                      {'\\', "\\textbackslash{}"},
                                                      {'<', "\\textless{}"},
                                                      {'>', "\\textgreater{}"}};
  std::string escaped;
  for (const char c : text) {
    const auto found = escapes.find(c);
    if (found == escapes.end()) {
      escaped += c;
    } else {
      escaped += found->second;
    }
  }
  return escaped;
}

/** Formats a booktabs tabular; numbers are right-aligned as on the page. */
std::string FormatLatex(const XMLElement& table) {
  std::string columns, head, rows;
  ForEachElement(table, [&](const XMLElement& row) {
    if (!HasTag(row, "tr")) return;
    std::string line;
    for (const auto* cell = row.FirstChildElement(); cell; cell = cell->NextSiblingElement()) {
      if (head.empty()) {
        columns += AttributeOf(*cell, "class").find("number") == std::string::npos ? 'l' : 'r';
      }
      line += (line.empty() ? "" : " & ") + EscapeLatex(TextBelow(*cell));
    }
    (head.empty() ? head : rows) += line + " \\\\\n";
  });
  return "\\begin{tabular}{" + columns + "}\n\\toprule\n" + head + "\\midrule\n" + rows +
         "\\bottomrule\n\\end{tabular}\n";
}

/** Shortens an id: "figure-success-rate-by-hand-and-by-grasp" with number 3 becomes
"03-success-rate-by-hand". */
std::string MakeShortName(const std::string& id, int number) {
  constexpr int kNumWords = 4;
  std::string name = fmt::format("{:02}", number);
  size_t at = id.find('-');
  for (int i = 0; i < kNumWords && at != std::string::npos; ++i) {
    const size_t next = id.find('-', at + 1);
    name += id.substr(at, next == std::string::npos ? next : next - at);
    at = next;
  }
  return name;
}

std::string FormatMethods(const XMLElement& methods) {
  std::string text = "# Methods\n";
  for (const auto* part = methods.FirstChildElement(); part; part = part->NextSiblingElement()) {
    text += "\n" + TextBelow(*part) + "\n";
  }
  return text;
}

/** Collects the files that a page provides, in the order of the page. */
class PaperMaker {
 public:
  explicit PaperMaker(PaperParts parts) : parts_(parts), style_(MakePlotStyle()) {}

  /** Takes the element and all its descendants.
  @param is_folded whether the element is inside a collapsed section */
  void Take(const XMLElement& element, bool is_folded) {
    if (AttributeOf(element, "id") == "provenance") has_tables_ = false;
    TakeOne(element, is_folded);
    is_folded = is_folded || HasTag(element, "details");
    for (const auto* child = element.FirstChildElement(); child;
         child = child->NextSiblingElement()) {
      Take(*child, is_folded);
    }
  }

  std::vector<PaperFile> Finish() {
    files_.push_back({"captions.md", captions_});
    return std::move(files_);
  }

 private:
  static constexpr int kMostFigures = 20, kMostTables = 12;

  bool IsWanted(bool is_folded, int& num_taken, int most) const {
    if (parts_ == PaperParts::kAll) return true;
    return !is_folded && num_taken++ < most;
  }

  void TakeOne(const XMLElement& element, bool is_folded) {
    const std::string id = AttributeOf(element, "id");
    if (HasTag(element, "figure") && !id.empty()) {
      TakeFigure(element, id, is_folded);
    } else if (HasTag(element, "div") && id.rfind("table-", 0) == 0) {
      TakeTable(element, id, is_folded);
    } else if (HasTag(element, "blockquote") && AttributeOf(element, "class") == "methods") {
      files_.push_back({"methods.md", FormatMethods(element)});
    } else if (HasTag(element, "pre") && AttributeOf(element, "class") == "bibtex") {
      files_.push_back({"refs.bib", TextBelow(element)});
    }
  }

  void TakeFigure(const XMLElement& element, const std::string& id, bool is_folded) {
    ++num_figures_;
    const XMLElement* plot = FindBelow(element, "svg", "plot");
    const XMLElement* caption = FindBelow(element, "figcaption", "");
    if (!plot || !caption || !IsWanted(is_folded, figures_taken_, kMostFigures)) return;
    const std::string name = "figures/fig-" + MakeShortName(id, num_figures_) + ".svg";
    files_.push_back({name, FormatPlot(*plot, style_)});
    AddCaption(*caption, name);
  }

  void TakeTable(const XMLElement& element, const std::string& id, bool is_folded) {
    ++num_tables_;
    const XMLElement* table = FindBelow(element, "table", "");
    if (!table || !has_tables_ || !IsWanted(is_folded, tables_taken_, kMostTables)) return;
    const std::string name = "tables/tab-" + MakeShortName(id, num_tables_);
    files_.push_back({name + ".csv", FormatTable(*table)});
    files_.push_back({name + ".tex", FormatLatex(*table)});
    AddCaption(*table->FirstChildElement(), name + ".csv, .tex");
  }

  void AddCaption(const XMLElement& caption, const std::string& name) {
    captions_ += "\n" + TextBelow(caption) + "\n(" + name + ")\n";
  }

  PaperParts parts_;
  std::string style_, captions_ = "# Figures and tables\n";
  std::vector<PaperFile> files_;
  bool has_tables_ = true;                    // false from versions and citation, the last section
  int num_figures_ = 0, num_tables_ = 0;      // on the page
  int figures_taken_ = 0, tables_taken_ = 0;  // those not folded
};

}  // namespace

std::vector<PaperFile> MakePaperFiles(const std::string& page, PaperParts parts) {
  tinyxml2::XMLDocument document;
  document.Parse(page.data(), page.size());
  GRASPBENCH_DEMAND(document.RootElement() != nullptr, "the page is not well-formed");
  PaperMaker maker(parts);
  maker.Take(*document.RootElement(), false);
  return maker.Finish();
}

}  // namespace graspbench
