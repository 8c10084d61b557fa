#include "reports/page/page_script.h"

#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/sha256.h"
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
  // The comments make it text for XML parsers, too.
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

}  // namespace graspbench
