#include "reports/page/provenance.h"

#include "core/base/error.h"
#include "core/base/text/json.h"
#include "core/base/version.h"
#include "core/physics/sim_config.h"
#include "reports/page/assets.h"
#include "reports/page/layout.h"

namespace graspbench {
namespace {

std::vector<std::pair<std::string, std::string>> ListFacts(const PageFrame& frame) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"graspbench, which made this page", program_version()},
      {"Physics of this graspbench", std::to_string(kPhysicsVersion)},
      {"Libraries of this graspbench", std::string(assets::kLibraries)}};
  facts.insert(facts.end(), frame.facts.begin(), frame.facts.end());
  return facts;
}

/** The entry with this key, up to its closing brace. */
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
  Table table("Versions and provenance.", {{"What"}, {"Value", Align::kProse}});
  for (const auto& [what, value] : ListFacts(frame)) table.AddRow({Text(what), Text(value)});
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
         (version == 0 ? "a physics that its folder does not name"
                       : "physics " + std::to_string(version)) +
         ", this graspbench has " + std::to_string(kPhysicsVersion);
}

Html MakeMethodsText(const std::vector<std::string>& paragraphs) {
  Html text;
  for (const std::string& paragraph : paragraphs) text += MakeParagraph(paragraph);
  return MakeParagraph("Ready to paste:") + Element("blockquote", {{"class", "methods"}}, text);
}

}  // namespace graspbench
