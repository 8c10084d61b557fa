#include "reports/page/write_page.h"

#include "core/base/files/files.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/provenance.h"

namespace graspbench {

std::filesystem::path WriteReportPage(const std::filesystem::path& folder, std::string_view page) {
  const std::filesystem::path report = folder / "report", path = report / "index.html";
  MakeFolder(report);
  UnsealOutput(report);
  WriteFileAtomically(path, page);
  SealOutput(report, {"index.html"}, MakeOutputOrigin(folder, "graspbench report ."));
  return path;
}

}  // namespace graspbench
