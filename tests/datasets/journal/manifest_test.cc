#include "datasets/journal/manifest.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

class ManifestFolder : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    MakeFolder(folder_ / "journal");
    WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
    WriteFile(folder_ / "journal/0.jsonl", "one\ntwo\nthree\n");
    Manifest manifest;
    manifest.kind = "session";
    manifest.versions = {{"schema", 4}};
    manifest.files = {SealJournal(folder_, "journal/0.jsonl"), SealFile(folder_, "session.json")};
    WriteManifest(folder_, manifest);
  }

  /** "" when nothing is wrong; the manifest's own damage counts. */
  std::string Look() const {
    try {
      std::string text;
      for (const Damage& damage : FindDamage(folder_, LoadManifest(folder_))) {
        text += damage.path + " " + damage.text + "\n";
      }
      return text;
    } catch (const Error& e) {
      return e.what();
    }
  }

  fs::path folder_ = fs::path(testing::TempDir()) / "manifest";
};

TEST_F(ManifestFolder, VouchesForWhatItHasSeen) {
  EXPECT_EQ(Look(), "");
  const Manifest manifest = LoadManifest(folder_);
  EXPECT_EQ(manifest.kind, "session");
  EXPECT_EQ(manifest.versions.at("schema"), 4);
  EXPECT_EQ(manifest.files[0].lines, 3);
}

TEST_F(ManifestFolder, EveryBitOfEveryFileCounts) {
  for (const char* path : {"session.json", "journal/0.jsonl", "manifest.json"}) {
    const std::string whole = ReadFile(folder_ / path);
    for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string flipped = whole;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      WriteFile(folder_ / path, flipped);
      ASSERT_NE(Look(), "") << path << ", bit " << bit;
    }
    WriteFile(folder_ / path, whole);
  }
  EXPECT_EQ(Look(), "");
}

TEST_F(ManifestFolder, CutsAreFoundAtEveryLength) {
  for (const char* path : {"session.json", "journal/0.jsonl", "manifest.json"}) {
    const std::string whole = ReadFile(folder_ / path);
    for (size_t length = 0; length < whole.size(); ++length) {
      WriteFile(folder_ / path, whole.substr(0, length));
      ASSERT_NE(Look(), "") << path << " cut to " << length;
    }
    WriteFile(folder_ / path, whole);
  }
}

TEST_F(ManifestFolder, AMissingFileAndSwappedLinesAreNamed) {
  fs::remove(folder_ / "session.json");
  EXPECT_EQ(Look(), "session.json is missing\n");
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
  WriteFile(folder_ / "journal/0.jsonl", "two\none\nthree\n");
  EXPECT_EQ(Look(), "journal/0.jsonl its committed lines have changed\n");
  WriteFile(folder_ / "journal/0.jsonl", "one\n");
  EXPECT_EQ(Look(), "journal/0.jsonl has 1 lines; 3 were committed\n");
}

TEST_F(ManifestFolder, AJournalMayGrowAndAFileMayNot) {
  WriteFile(folder_ / "journal/0.jsonl", "one\ntwo\nthree\nfour\nfi");
  EXPECT_EQ(Look(), "");
  EXPECT_EQ(SealJournal(folder_, "journal/0.jsonl").lines, 4) << "a torn line is not committed";
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n\n");
  EXPECT_EQ(Look(), "session.json has 12 bytes instead of 11\n");
}

TEST_F(ManifestFolder, AJournalWithoutAWholeLineIsEmpty) {
  WriteFile(folder_ / "journal/0.jsonl", "torn");
  const ManifestFile sealed = SealJournal(folder_, "journal/0.jsonl");
  EXPECT_EQ(sealed.lines, 0);
  EXPECT_EQ(sealed.bytes, 0u);
}

}  // namespace
}  // namespace graspbench
