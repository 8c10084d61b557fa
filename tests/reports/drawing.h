#pragma once
/** @file
A plot as its test sees it: parsed, and searched by tag and class. */

#include <tinyxml2.h>

#include <cstring>
#include <vector>

#include "reports/page/html.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {

struct Drawing {
  explicit Drawing(const Html& html) {
    ParsePage(html.markup(), document);
    svg = document.RootElement();
  }
  std::vector<const tinyxml2::XMLElement*> Find(const char* tag, const char* css_class) const {
    std::vector<const tinyxml2::XMLElement*> found;
    Collect(*svg, tag, css_class, found);
    return found;
  }
  static void Collect(const tinyxml2::XMLElement& root, const char* tag, const char* css_class,
                      std::vector<const tinyxml2::XMLElement*>& found) {
    const char* its_class = root.Attribute("class");
    if (std::strcmp(root.Name(), tag) == 0 && its_class && std::strcmp(its_class, css_class) == 0) {
      found.push_back(&root);
    }
    for (const auto* c = root.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) {
      Collect(*c, tag, css_class, found);
    }
  }
  tinyxml2::XMLDocument document;
  const tinyxml2::XMLElement* svg = nullptr;
};

}  // namespace graspbench
