#include "datasets/journal/manifest.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

std::string MakeLine(const char* id) { return FormatCheckedLine({{"trial_id", id}}) + "\n"; }
const std::string kLines = MakeLine("one") + MakeLine("two") + MakeLine("three");

class ManifestFolder : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    MakeFolder(folder_ / "journal");
    WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
    WriteFile(folder_ / "journal/0.jsonl", kLines);
    Manifest manifest;
    manifest.kind = "session";
    manifest.versions = {{"schema", 4}};
    manifest.files = {SealJournal(folder_, "journal/0.jsonl", false),
                      SealFile(folder_, "session.json")};
    WriteManifest(folder_, manifest);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /** "" when nothing is wrong; the manifest's own damage counts. */
  std::string Look() const {
    try {
      return FormatDamage(FindDamage(folder_, LoadManifest(folder_)));
    } catch (const Error& e) {
      return e.what();
    }
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("manifest_" + std::to_string(::getpid()));
};

TEST_F(ManifestFolder, VouchesForWhatItHasSeen) {
  EXPECT_EQ(Look(), "");
  const Manifest manifest = LoadManifest(folder_);
  EXPECT_EQ(manifest.kind, "session");
  EXPECT_EQ(manifest.versions.at("schema"), 4);
  EXPECT_EQ(manifest.files[0].lines, 3);
}

TEST_F(ManifestFolder, TellsWhatSomethingWasMadeFrom) {
  Manifest manifest = LoadManifest(folder_);
  EXPECT_FALSE(manifest.origin);
  manifest.origin = {"graspbench export .", {{"commit", "abc"}}, {{"../plan.jsonl", "123"}}};
  WriteManifest(folder_, manifest);
  const Manifest again = LoadManifest(folder_);
  ASSERT_TRUE(again.origin);
  EXPECT_EQ(again.origin->command, "graspbench export .");
  EXPECT_EQ(again.origin->versions["commit"], "abc");
  ASSERT_EQ(again.origin->inputs.size(), 1u);
  EXPECT_EQ(again.origin->inputs[0].path, "../plan.jsonl");
  EXPECT_EQ(again.origin->inputs[0].sha256, "123");
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
  EXPECT_EQ(Look(), "\n  session.json: is missing");
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n");
  WriteFile(folder_ / "journal/0.jsonl", MakeLine("two") + MakeLine("one") + MakeLine("three"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl: its committed lines have changed");
  WriteFile(folder_ / "journal/0.jsonl", MakeLine("one") + "{\"damaged\"}\n");
  EXPECT_EQ(Look(),
            "\n  journal/0.jsonl: has 58 bytes and 2 lines; 140 bytes and 3 lines were committed"
            "\n  journal/0.jsonl:2: the line is cut off or is no record");
}

TEST_F(ManifestFolder, AJournalMayGrowByWholeLinesAndAFileMayNot) {
  WriteFile(folder_ / "journal/0.jsonl", kLines + MakeLine("four") + "{\"fi");
  EXPECT_EQ(Look(), "");
  EXPECT_EQ(SealJournal(folder_, "journal/0.jsonl", false).lines, 4);
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"fi\n" + MakeLine("four"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl:4: the line is cut off or is no record");
  WriteFile(folder_ / "journal/0.jsonl", kLines);
  WriteFile(folder_ / "session.json", "{\"seed\":1}\n\n");
  EXPECT_EQ(Look(), "\n  session.json: has more than 11 bytes");
}

// A crash tears a line, the next run commits it as it is and goes on behind a line break.
TEST_F(ManifestFolder, ATornLineThatWasCommittedIsNoDamageUnlessItIsContinued) {
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to");
  Manifest manifest = LoadManifest(folder_);
  manifest.files[0] = SealJournal(folder_, "journal/0.jsonl", true);
  WriteManifest(folder_, manifest);
  EXPECT_EQ(Look(), "");
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to\n" + MakeLine("four"));
  EXPECT_EQ(Look(), "");
  WriteFile(folder_ / "journal/0.jsonl", kLines + "{\"to" + MakeLine("four"));
  EXPECT_EQ(Look(), "\n  journal/0.jsonl:4: a torn line was continued");
}

TEST_F(ManifestFolder, AJournalWithoutAWholeLineIsEmpty) {
  WriteFile(folder_ / "journal/0.jsonl", "torn");
  const ManifestFile sealed = SealJournal(folder_, "journal/0.jsonl", false);
  EXPECT_EQ(sealed.lines, 0);
  EXPECT_EQ(sealed.bytes, 0u);
}

TEST(DescribeDamage, NamesAtMostTen) {
  EXPECT_EQ(DescribeDamage({}), "");
  EXPECT_EQ(DescribeDamage({{"a", 3, "is torn"}, {"b", 0, "is missing"}}),
            ". READ IN SPITE OF DAMAGE: a:3: is torn; b: is missing");
  const std::vector<Damage> many(12, {"a", 0, "is missing"});
  EXPECT_NE(FormatDamage(many).find("\n  and 2 more"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
