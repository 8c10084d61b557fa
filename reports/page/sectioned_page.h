#pragma once
/** @file
Pages made of sections: a list in the order of the page, each drawn from the same data. */

#include <string>
#include <utility>
#include <vector>

#include "reports/page/layout.h"

namespace graspbench {

template <class Data>
struct PageSection {
  const char* anchor;  ///< lower-case letters only, so that it never meets another anchor
  const char* title;
  Html (*draw)(const Data& data);  ///< must bear empty data
};

template <class Data>
std::string MakeSectionedPage(const PageFrame& frame,
                              const std::vector<PageSection<Data>>& sections, const Data& data) {
  std::vector<PageLink> contents;
  Html body;
  for (const PageSection<Data>& section : sections) {
    contents.push_back({section.anchor, section.title});
    Html content = Element("h2", {}, section.title);
    content += section.draw(data);
    body += Element("section", {{"id", section.anchor}}, content);
  }
  return MakePage(frame, contents, std::move(body));
}

template <class Data>
std::string MakeSectionedPage(const std::string& title, const std::string& subtitle,
                              const std::vector<PageSection<Data>>& sections, const Data& data) {
  return MakeSectionedPage(PageFrame{title, subtitle}, sections, data);
}

}  // namespace graspbench
