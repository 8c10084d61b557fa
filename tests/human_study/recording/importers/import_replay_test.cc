#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fuzz/fuzz_import.h"

namespace graspbench {
namespace {

/** Every importer has cases, and every case ends in a recording or an Error. */
TEST(ImportReplay, EveryCaseEndsWell) {
  const std::filesystem::path root = FindDataRoot() / "tests/fuzz/cases/mocap_import";
  for (const Importer& importer : ImporterList()) {
    std::vector<std::filesystem::path> cases;
    for (const auto& entry : std::filesystem::directory_iterator(root / importer.id)) {
      cases.push_back(entry.path());
    }
    std::sort(cases.begin(), cases.end());
    EXPECT_GE(cases.size(), 1u) << importer.id;
    for (const std::filesystem::path& path : cases) {
      SCOPED_TRACE(path.string());
      EXPECT_NO_THROW(FuzzImport(importer.id, ReadFile(path)));
    }
  }
}

/** Every prefix of a good file and every single damaged byte of its first kilobyte. */
TEST(ImportReplay, PrefixesAndDamagedBytesOfGoodFilesEndWell) {
  const std::filesystem::path root = FindDataRoot() / "tests/fuzz/cases/mocap_import";
  for (const Importer& importer : ImporterList()) {
    const std::string good = ReadFile(root / importer.id / "good");
    for (size_t size = 0; size <= good.size(); size += 1 + good.size() / 400) {
      FuzzImport(importer.id, good.substr(0, size));
    }
    for (size_t at = 0; at < std::min<size_t>(good.size(), 1024); ++at) {
      std::string damaged = good;
      damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
      FuzzImport(importer.id, damaged);
    }
  }
}

}  // namespace
}  // namespace graspbench
