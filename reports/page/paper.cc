#include "reports/page/paper.h"

#include <tinyxml2.h>

#include <cstring>
#include <functional>

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

/** Calls `take` for the element and all below it, in the page's order. */
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

/** Without what a caption advises to look for. */
std::string TextBelow(const tinyxml2::XMLNode& node) {
  if (const auto* text = node.ToText()) return text->Value();
  if (node.ToElement() && AttributeOf(*node.ToElement(), "class") == "look") return {};
  std::string all;
  for (const auto* child = node.FirstChild(); child; child = child->NextSibling()) {
    all += TextBelow(*child);
  }
  return all;
}

/** The value that style.css gives a variable by day, which stands there first. */
std::string FindColour(const std::string& variable) {
  const std::string_view style = assets::kStyle;
  const std::string start = "  " + variable + ": ";
  const size_t at = style.find(start);
  GRASPBENCH_DEMAND(at != std::string_view::npos, variable);
  const size_t begin = at + start.size();
  return std::string(style.substr(begin, style.find(';', begin) - begin));
}

/** The rules of plot.css with values in place of variables: few programs know those in SVG. */
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
  const size_t centred = style.find(kCentred);  // each text has the shift itself, see FormatPlot
  if (centred != std::string::npos) style.erase(centred, kCentred.size());
  return style;
}

/** Texts are centred about y by a shift that every program knows, links become groups. */
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

std::string FormatMethods(const XMLElement& methods) {
  std::string text = "# Methods\n";
  for (const auto* part = methods.FirstChildElement(); part; part = part->NextSiblingElement()) {
    text += "\n" + TextBelow(*part) + "\n";
  }
  return text;
}

}  // namespace

std::vector<PaperFile> MakePaperFiles(const std::string& page) {
  tinyxml2::XMLDocument document;
  document.Parse(page.data(), page.size());
  GRASPBENCH_DEMAND(document.RootElement() != nullptr, "the page is not well-formed");
  const std::string style = MakePlotStyle();
  std::vector<PaperFile> files;
  std::string captions = "# Figures and tables\n";
  const auto add = [&](const std::string& name, const std::string& content,
                       const XMLElement& caption) {
    files.push_back({name, content});
    captions += "\n" + TextBelow(caption) + "\n(" + name + ")\n";
  };
  ForEachElement(*document.RootElement(), [&](const XMLElement& element) {
    const std::string id = AttributeOf(element, "id");
    if (HasTag(element, "figure") && !id.empty()) {
      const XMLElement* plot = FindBelow(element, "svg", "plot");
      const XMLElement* caption = FindBelow(element, "figcaption", "");
      if (plot && caption) add("figures/" + id + ".svg", FormatPlot(*plot, style), *caption);
    } else if (HasTag(element, "div") && id.rfind("table-", 0) == 0) {
      const XMLElement* table = FindBelow(element, "table", "");
      if (table) add("tables/" + id + ".csv", FormatTable(*table), *table->FirstChildElement());
    } else if (HasTag(element, "blockquote") && AttributeOf(element, "class") == "methods") {
      files.push_back({"methods.md", FormatMethods(element)});
    } else if (HasTag(element, "pre") && AttributeOf(element, "class") == "bibtex") {
      files.push_back({"refs.bib", TextBelow(element)});
    }
  });
  files.push_back({"captions.md", captions});
  return files;
}

}  // namespace graspbench
