#include "workbench/manual/maker/manual_site.h"

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "workbench/manual/maker/manual_assets.h"
#include "workbench/manual/maker/markdown.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct WrittenPage {
  ManualPage page;
  ManualText text;
};

std::string MakeMarkdown(const ManualPage& page, const Command& program, const fs::path& source) {
  if (page.room == "reference") return MakeReference(page.id, program);
  // Made from the rows of validation/ and kept beside them, for readers of the sources.
  if (page.id == "validation") return ReadFile(source / "validation.md");
  return ReadFile(source / "pages" / (page.id + ".md"));
}

/** "grasps.md#opening" is "grasps.html#opening". */
std::string FindLink(const std::string& target) {
  const size_t hash = std::min(target.find('#'), target.size());
  const std::string file = target.substr(0, hash);
  if (file.empty()) return target;
  for (const ManualPage& page : ListManualPages()) {
    if (file == page.id + ".md") return page.id + ".html" + target.substr(hash);
  }
  throw Error(ErrorKind::kFormat, "the link \"" + target + "\" leads to no page of the manual");
}

/** Anchors of other pages are known when all pages have been read. */
void CheckAnchors(const std::vector<WrittenPage>& pages) {
  std::map<std::string, std::string> bodies;
  for (const WrittenPage& page : pages) {
    bodies[page.page.id + ".html"] = page.text.body.markup();
  }
  for (const auto& [name, body] : bodies) {
    const std::string opening = "<a href=\"";
    for (size_t at = body.find(opening); at != body.npos; at = body.find(opening, at + 1)) {
      const size_t begin = at + opening.size();
      const std::string link = body.substr(begin, body.find('"', begin) - begin);
      const size_t hash = link.find('#');
      if (hash == link.npos || link.find("://") != link.npos) continue;
      const std::string& target = hash == 0 ? body : bodies.at(link.substr(0, hash));
      if (target.find(" id=\"" + link.substr(hash + 1) + "\"") != target.npos) continue;
      throw Error(ErrorKind::kFormat, name + ": the link \"" + link + "\" leads to no heading");
    }
  }
}

/** Contents of the whole manual; of the page that is shown, its sections, too. */
Html DrawNavigation(const std::vector<WrittenPage>& pages, const WrittenPage* shown) {
  Html list = Element("li", {}, Element("a", {{"href", "index.html"}}, "Contents and search"));
  std::string room;
  for (const WrittenPage& page : pages) {
    if (page.page.room != room) {
      room = page.page.room;
      list += Element("li", {{"class", "room"}}, Capitalise(room));
    }
    Attributes attributes = {{"href", page.page.id + ".html"}};
    if (&page == shown) attributes.push_back({"aria-current", "page"});
    list += Element("li", {}, Element("a", attributes, page.text.title));
  }
  return list;
}

/** What is on a long page, above its text. */
Html DrawSections(const ManualText& text) {
  Html links;
  for (const ManualSection& section : text.sections) {
    if (!section.anchor.empty()) {
      links += Element("li", {}, LinkTo(section.anchor, section.title));
    }
  }
  return text.sections.size() < 4 ? Html() : MakeDetails("On this page", Element("ul", {}, links));
}

Json MakeSearchIndex(const std::vector<WrittenPage>& pages) {
  Json index = Json::array();
  for (const WrittenPage& page : pages) {
    for (const auto* list : {&page.text.sections, &page.text.rows}) {
      for (const ManualSection& section : *list) {
        const std::string anchor = section.anchor.empty() ? "" : "#" + section.anchor;
        index.push_back(
            {page.page.id + ".html" + anchor, page.text.title, section.title, section.text});
      }
    }
  }
  return index;
}

std::string EscapeScript(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : std::string(1, c);
  return safe;
}

std::string MakeIndexPage(const std::vector<WrittenPage>& pages) {
  Html body = Element("p", {},
                      Element("label", {{"for", "query"}}, "Search the manual") + Text(" ") +
                          Element("input", {{"id", "query"}, {"type", "search"}})) +
              Element("div", {{"id", "hits"}, {"aria-live", "polite"}});
  Html contents;
  for (size_t i = 0; i < pages.size(); ++i) {
    const WrittenPage& page = pages[i];
    contents += Element("li", {},
                        Element("a", {{"href", page.page.id + ".html"}}, page.text.title) +
                            Text(". " + page.text.subtitle));
    if (i + 1 < pages.size() && pages[i + 1].page.room == page.page.room) continue;
    body += Element("h2", {{"id", page.page.room}}, Capitalise(page.page.room)) +
            Element("ul", {}, contents);
    contents = Html();
  }
  const std::string page = MakePlainPage({"The graspbench manual",
                                          "Grasping experiments with robot hands and with people.",
                                          DrawNavigation(pages, nullptr), body});
  return AddScript(page, {std::string(assets::kManualCss),
                          "const sections = " + EscapeScript(FormatJson(MakeSearchIndex(pages))) +
                              ";\n" + std::string(assets::kManualSearchJs)});
}

}  // namespace

const std::vector<ManualPage>& ListManualPages() {
  static const std::vector<ManualPage> pages = {
#define GRASPBENCH_PAGE(room, id) {#room, #id},
#include "workbench/manual/contents.inc"
#undef GRASPBENCH_PAGE
  };
  return pages;
}

void WriteManual(const Command& program, const fs::path& source, const fs::path& folder) {
  std::vector<WrittenPage> pages;
  for (const ManualPage& page : ListManualPages()) {
    pages.push_back({page, ReadMarkdown(MakeMarkdown(page, program, source),
                                        {page.id + ".md", source / "pictures", &FindLink})});
  }
  CheckAnchors(pages);
  MakeFolder(folder);
  WriteFile(folder / "index.html", MakeIndexPage(pages));
  for (const WrittenPage& page : pages) {
    WriteFile(
        folder / (page.page.id + ".html"),
        AddStyle(MakePlainPage({page.text.title, page.text.subtitle, DrawNavigation(pages, &page),
                                DrawSections(page.text) + page.text.body}),
                 std::string(assets::kManualCss)));
  }
}

}  // namespace graspbench
