#include "reports/page/write_page.h"

#include "core/base/files/files.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/provenance.h"

namespace graspbench {
namespace {

/** What the page shows. Of the experiments on a session's draws it is the sensitivity, a run that
comes later among it; empty: the whole store. */
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

}  // namespace graspbench
