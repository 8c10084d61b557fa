#include "tests/reports/report_fixture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "core/base/hash.h"
#include "core/base/text/json.h"
#include "reports/page/html.h"

namespace graspbench {

std::string MakePageOf(const Session& session) {
  return MakeSessionReport({session, SummariseSession(session), SessionModels(), CellPictures()});
}

void ParsePage(const std::string& page, tinyxml2::XMLDocument& document) {
  ASSERT_EQ(document.Parse(page.data(), page.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  ASSERT_NE(document.RootElement(), nullptr);
}

std::string ListText(const tinyxml2::XMLElement& element) {
  if (std::strcmp(element.Name(), "style") == 0 || std::strcmp(element.Name(), "script") == 0) {
    return {};
  }
  std::string text;
  for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (const auto* leaf = node->ToText()) text += leaf->Value();
    if (const auto* child = node->ToElement()) {
      const std::string inner = ListText(*child);
      if (inner.empty()) continue;
      if (!text.empty() && text.back() != ' ') text += " ";
      text += inner + " ";
    }
  }
  return text;
}

const tinyxml2::XMLElement* FindById(const tinyxml2::XMLElement& root, const std::string& id) {
  if (root.Attribute("id", id.c_str())) return &root;
  for (const auto* child = root.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const auto* found = FindById(*child, id)) return found;
  }
  return nullptr;
}

std::vector<std::string> ListAttribute(const tinyxml2::XMLElement& root, const char* name) {
  std::vector<std::string> values;
  if (const char* value = root.Attribute(name)) values.push_back(value);
  for (const auto* child = root.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    for (const std::string& value : ListAttribute(*child, name)) values.push_back(value);
  }
  return values;
}

namespace {

/** The provenance, which is data, and the one script that the policy names; nothing is fetched. */
void ExpectKnownScripts(const std::string& page) {
  const std::string data = "<script type=\"application/ld+json\">", code = "<script>";
  const size_t data_at = page.find(data), code_at = page.find(code);
  ASSERT_NE(data_at, std::string::npos);
  ASSERT_NE(code_at, std::string::npos);
  size_t count = 0;
  for (size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", at + 1))
    ++count;
  EXPECT_EQ(count, 2u);
  const size_t data_end = page.find("</script>", data_at);
  const Json provenance =
      Json::parse(page.substr(data_at + data.size(), data_end - data_at - data.size()));
  EXPECT_EQ(provenance.at("creator").at("name"), "graspbench");
  const size_t begin = code_at + code.size();
  const std::string script = page.substr(begin, page.find("</script>", begin) - begin);
  std::string digest;
  const std::string hex = CalcSha256(script);
  for (size_t i = 0; i < hex.size(); i += 2)
    digest += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  EXPECT_NE(page.find("script-src 'sha256-" + EncodeBase64(digest) + "'"), std::string::npos);
  const std::string rest = page.substr(0, data_at) + page.substr(data_end, code_at - data_end) +
                           page.substr(begin + script.size());
  EXPECT_EQ(rest.find("http:"), std::string::npos);
  EXPECT_EQ(rest.find("https:"), std::string::npos);
  for (const char* request : {"fetch(", "XMLHttpRequest", "import(", "innerHTML", "eval("}) {
    EXPECT_EQ(script.find(request), std::string::npos) << request;
  }
}

}  // namespace

std::string TextOf(const std::string& page) {
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  return ListText(*document.RootElement());
}

std::string TextOfId(const std::string& page, const std::string& id) {
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement* found = FindById(*document.RootElement(), id);
  return found ? ListText(*found) : "no element " + id;
}

void ExpectParts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is missing in:\n" << text;
  }
}

void ExpectSoundPage(const std::string& page) {
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  const std::vector<std::string> ids = ListAttribute(root, "id");
  const std::set<std::string> known(ids.begin(), ids.end());
  EXPECT_EQ(known.size(), ids.size()) << "an id is used twice";
  for (const std::string& href : ListAttribute(root, "href")) {
    if (href.rfind("data:image/webp;base64,", 0) == 0) continue;  // an <image> of a drawing
    EXPECT_TRUE(href[0] == '#' && known.count(href.substr(1)) == 1) << href;
  }
  for (const std::string& src : ListAttribute(root, "src")) {
    EXPECT_EQ(src.rfind("data:image/webp;base64,", 0), 0u) << src.substr(0, 60);
  }
  ExpectKnownScripts(page);
  EXPECT_EQ(page.find("url("), std::string::npos);
  char level = '1';
  for (size_t at = page.find("<h"); at != std::string::npos; at = page.find("<h", at + 1)) {
    const char digit = page[at + 2];
    if (digit < '1' || digit > '6') continue;
    EXPECT_LE(digit, level + 1) << page.substr(at, 80);
    level = digit;
  }
}

}  // namespace graspbench
