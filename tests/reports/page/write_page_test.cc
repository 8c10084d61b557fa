#include "reports/page/write_page.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "datasets/journal/manifest.h"

namespace graspbench {
namespace {

TEST(WriteReportPage, SealsWhatItWrote) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "write_page";
  std::filesystem::remove_all(folder);
  for (const char* page : {"first", "second"}) {
    EXPECT_EQ(WriteReportPage(folder, page), folder / "report" / "index.html");
    EXPECT_EQ(ReadFile(folder / "report" / "index.html"), page);
    const Manifest manifest = LoadManifest(folder / "report");
    ASSERT_EQ(manifest.files.size(), 1u);
    EXPECT_TRUE(FindDamage(folder / "report", manifest).empty());
  }
}

}  // namespace
}  // namespace graspbench
