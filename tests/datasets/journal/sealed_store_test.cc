#include "datasets/journal/sealed_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/journal/store_mutations.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {
namespace fs = std::filesystem;

class SealedStore : public testing::Test {
 protected:
  SealedStore() : stores_(MakeStores(folder_.path())), session_(stores_[0]) {}

  std::string Look(const fs::path& store) const { return FormatDamage(CheckStore(store).damages); }
  /** Replaces the first occurrence of a text in a file. */
  void Edit(const fs::path& path, const std::string& from, const std::string& to) const {
    std::string text = ReadFile(path);
    ASSERT_NE(text.find(from), text.npos) << path;
    WriteFile(path, text.replace(text.find(from), from.size(), to));
  }

  TemporaryFolder folder_;
  std::vector<fs::path> stores_;
  fs::path session_;
};

TEST_F(SealedStore, IsWholeAsItWasWritten) {
  const std::vector<std::string> kinds = {"session", "session", "optimisation", "campaign",
                                          "study"};
  for (size_t i = 0; i < stores_.size(); ++i) {
    EXPECT_EQ(CheckStore(stores_[i]).kind, kinds[i]);
    EXPECT_EQ(Look(stores_[i]), "");
    EXPECT_TRUE(RepairStore(stores_[i]).actions.empty());
  }
  EXPECT_THROW(CheckStore(folder_.path()), Error);
}

TEST_F(SealedStore, AFolderOrAPipeInPlaceOfAFileIsDamage) {
  for (const char* name : {"journal/0.jsonl", "journal/9.jsonl", "plan.jsonl", "session.json"}) {
    const fs::path path = session_ / name, aside = session_ / ".aside";
    const bool is_there = fs::exists(path);
    if (is_there) fs::rename(path, aside);
    fs::create_directory(path);
    EXPECT_TRUE(Has(Look(session_), name)) << name << Look(session_);
    fs::remove(path);
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_TRUE(Has(Look(session_), name)) << name << Look(session_);
    fs::remove(path);
    if (is_there) fs::rename(aside, path);
  }
  EXPECT_EQ(Look(session_), "");
}

// The cases that were believed before there was a manifest.
TEST_F(SealedStore, AnotherSeedStepOrPhysicsIsFound) {
  const fs::path frozen = session_ / "session.json";
  const std::string whole = ReadFile(frozen);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\"seed\": 1", "\"seed\": 2"},
           {"\"step_s\": 0.002", "\"step_s\": 0.001"},
           {"\"physics_version\": ", "\"physics_version\": 1"},
           {"\"schema\": 7", "\"schema\": 6"}}) {
    Edit(frozen, from, to);
    EXPECT_NE(Look(session_), "") << from;
    WriteFile(frozen, whole);
  }
  EXPECT_EQ(Look(session_), "");
}

TEST_F(SealedStore, APlanCutAtALineEndAndAnEmptiedJournalAreFound) {
  const std::string plan = ReadFile(session_ / "plan.jsonl");
  WriteFile(session_ / "plan.jsonl", plan.substr(0, plan.find('\n', plan.size() / 2) + 1));
  EXPECT_NE(Look(session_).find("\n  plan.jsonl: has "), std::string::npos) << Look(session_);
  WriteFile(session_ / "plan.jsonl", plan);
  WriteFile(session_ / "journal/0.jsonl", "");
  EXPECT_NE(Look(session_).find("\n  journal/0.jsonl: has 0 bytes and 0 lines; "),
            std::string::npos)
      << Look(session_);
  try {
    LoadSession(session_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kFormat);
    EXPECT_NE(std::string(error.what()).find("verify --repair"), std::string::npos);
  }
}

TEST_F(SealedStore, ScenesThatChangedPlacesAreFound) {
  const fs::path scenes = stores_[3] / "scenes";
  fs::rename(scenes / "tum-mug", scenes / "aside");
  fs::rename(scenes / "tum-pencil", scenes / "tum-mug");
  fs::rename(scenes / "aside", scenes / "tum-pencil");
  EXPECT_NE(Look(stores_[3]), "");
}

TEST_F(SealedStore, RepairSetsTheDamagedLineAsideAndKeepsTheOthers) {
  const size_t num_records = LoadSession(session_).records.size();
  const std::string before = ReadFile(session_ / "journal/0.jsonl");
  Edit(session_ / "journal/0.jsonl", "\"outcome\"", "\"outkome\"");
  const std::string damaged = ReadFile(session_ / "journal/0.jsonl");
  const StoreRepair repair = RepairStore(session_);
  EXPECT_EQ(repair.actions.size(), 2u);
  EXPECT_TRUE(repair.state.damages.empty());
  EXPECT_EQ(LoadSession(session_).records.size(), num_records - 1);
  const std::string aside = ReadFile(session_ / "journal/0.jsonl.damaged");
  EXPECT_EQ(aside, damaged.substr(0, damaged.find('\n') + 1));
  EXPECT_EQ(ReadFile(session_ / "journal/0.jsonl"), before.substr(before.find('\n') + 1));
}

TEST_F(SealedStore, RepairDoesNotBlessAChangedConfiguration) {
  Edit(session_ / "session.json", "\"seed\": 1", "\"seed\": 2");
  EXPECT_EQ(FormatDamage(RepairStore(session_).state.damages),
            "\n  session.json: its bytes have changed");
  try {
    LoadSession(session_);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(Has(text, "no repair can restore session.json: "));
    EXPECT_EQ(text.find("verify --repair"), text.npos) << text;
  }
  SealStore(kSessionStore, session_);  // nor does a run that accepts it
  EXPECT_EQ(Look(session_), "\n  session.json: its bytes have changed");
}

TEST_F(SealedStore, ALostManifestIsSpokenOfForEver) {
  const std::string expected =
      "\n  manifest.json: was rebuilt after a loss: earlier changes cannot be detected";
  for (const fs::path& store : {session_, stores_[3]}) {
    fs::remove(store / "manifest.json");
    EXPECT_FALSE(RepairStore(store).actions.empty());
    EXPECT_TRUE(CheckStore(store).is_made_anew);
  }
  SealStore(kSessionStore, session_);
  EXPECT_EQ(FormatDamage(LoadSession(session_).damage), expected);
  EXPECT_EQ(FormatDamage(LoadCampaign(stores_[3]).damage), expected);
}

TEST_F(SealedStore, DerivedFilesAreMadeAnew) {
  const fs::path scene = stores_[2];
  Edit(scene / "new-target.yaml", "mug", "jug");
  const StoreRepair repair = RepairStore(scene);
  EXPECT_TRUE(repair.state.damages.empty()) << FormatDamage(repair.state.damages);
  EXPECT_EQ(ReadFile(scene / "new-target.yaml.damaged"), "target of: jug\n");
  const Manifest manifest = LoadManifest(scene);
  for (const ManifestFile& file : manifest.files) EXPECT_NE(file.path, "result.json");
  EXPECT_EQ(manifest.inputs, "hash of mug");
}

TEST_F(SealedStore, DamageInsideACampaignIsNamedFromItsFolder) {
  const fs::path campaign = stores_[3];
  Edit(campaign / "scenes/tum-mug/journal.jsonl", "search", "zearch");
  EXPECT_TRUE(Has(Look(campaign), "\n  scenes/tum-mug/journal.jsonl:1: "));
  fs::remove_all(campaign / "benchmark");
  EXPECT_TRUE(Has(Look(campaign), "benchmark/session.json: is missing"));
}

// Nothing is read from them again, so they stop nobody, but they are not believed either.
TEST_F(SealedStore, AChangedExportOrPageIsNamedAndStopsNoReader) {
  ExportSession(session_, LoadSession(session_));
  MakeFolder(session_ / "report");
  WriteFile(session_ / "report/index.html", "page");
  SealOutput(session_ / "report", {"index.html"}, {});
  EXPECT_EQ(Look(session_), "");
  for (const char* name : {"export/trials.csv", "export/events.csv", "export/trials.schema.json",
                           "export/events.schema.json", "index.sqlite", "report/index.html"}) {
    const std::string whole = ReadFile(session_ / name);
    std::string flipped = whole;
    flipped[whole.size() / 2] ^= 4;
    WriteFile(session_ / name, flipped);
    EXPECT_EQ(Look(session_), std::string("\n  ") + name + ": its bytes have changed");
    LoadSession(session_);
    fs::remove(session_ / name);
    EXPECT_EQ(Look(session_), std::string("\n  ") + name + ": is missing");
    WriteFile(session_ / name, whole);
  }
  EXPECT_EQ(Look(session_), "");
  Edit(session_ / "export/manifest.json", "trials", "tryals");
  EXPECT_EQ(Look(session_), "\n  export/manifest.json: its bytes have changed");
}

TEST_F(SealedStore, RepairSetsAChangedExportAside) {
  ExportSession(session_, LoadSession(session_));
  Edit(session_ / "export/trials.csv", "trial_id", "trial_ID");
  WriteFile(session_ / "index.sqlite", "");
  const StoreRepair repair = RepairStore(session_);
  EXPECT_EQ(repair.actions,
            (std::vector<std::string>{"index.sqlite: set aside as index.sqlite.damaged; graspbench "
                                      "export makes it again",
                                      "export/trials.csv: set aside as export/trials.csv.damaged; "
                                      "graspbench export makes it again"}));
  EXPECT_TRUE(repair.state.damages.empty());
  EXPECT_EQ(ReadFile(session_ / "export/trials.csv.damaged").substr(0, 8), "trial_ID");
  ExportSession(session_, LoadSession(session_));
  EXPECT_EQ(Look(session_), "");
}

TEST_F(SealedStore, ANewExportKeepsWhatAPersonHasChangedAndFollowsNoLink) {
  ExportSession(session_, LoadSession(session_));
  const std::string whole = ReadFile(session_ / "export/trials.csv");
  Edit(session_ / "export/trials.csv", "trial_id", "my notes");
  const std::string changed = ReadFile(session_ / "export/trials.csv");
  ExportSession(session_, LoadSession(session_));
  EXPECT_EQ(ReadFile(session_ / "export/trials.csv"), whole);
  EXPECT_EQ(ReadFile(session_ / "export/trials.csv.set-aside"), changed);
  EXPECT_FALSE(fs::exists(session_ / "export/events.csv.set-aside"));

  fs::rename(session_ / "export", session_ / "elsewhere");
  fs::create_directory_symlink(session_ / "elsewhere", session_ / "export");
  EXPECT_THROW(ExportSession(session_, LoadSession(session_)), Error);
  EXPECT_EQ(ReadFile(session_ / "elsewhere/trials.csv"), whole);
}

// Killed between the first byte of an export and its last, nothing vouches for it.
TEST_F(SealedStore, AnExportThatWasNotFinishedIsNoDamage) {
  ExportSession(session_, LoadSession(session_));
  UnsealOutput(session_ / "export");
  Edit(session_ / "export/trials.csv", "trial_id", "trial_ID");
  EXPECT_EQ(Look(session_), "");
}

TEST(StoreMutations, AreFoundAndLoseNoWholeLine) {
  const TemporaryFolder folder;
  const MutationCount count = MutateStores(folder.path(), "quick", 300);
  EXPECT_EQ(count.examples, "");
  EXPECT_EQ(count.mutations, 300);
}

using Names = std::vector<std::string>;

TEST(UnverifiedFiles, AreMadeFilesWithoutAHash) {
  const TemporaryFolder folder;
  MakeStores(folder.path());
  const auto find = [&](const char* store) { return FindUnverified(folder.path() / store); };
  for (const char* store : {"session", "scene", "campaign", "study", "nowhere"}) {
    EXPECT_EQ(find(store), Names()) << store;
  }
  const std::filesystem::path campaign = folder.path() / "campaign";
  WriteFile(campaign / "comparison.csv", "hand,object\n");
  WriteFile(campaign / "scenes" / "tum-mug" / "new-other.yaml", "x: 1\n");
  WriteFile(campaign / "notes.txt", "a person's own\n");
  EXPECT_EQ(find("campaign"), (Names{"comparison.csv", "scenes/tum-mug/new-other.yaml"}));
  EXPECT_TRUE(CheckStore(campaign).damages.empty());
  SealStore(kCampaignStore, campaign);
  EXPECT_EQ(find("campaign"), Names{"scenes/tum-mug/new-other.yaml"});
  EXPECT_EQ(DescribeUnverified("comparison.csv"),
            "comparison.csv: cannot be verified, because it has no stored hash");
}

TEST(UnverifiedFiles, AreTablesWhoseManifestIsGone) {
  const TemporaryFolder folder;
  MakeStores(folder.path());
  const std::filesystem::path session = folder.path() / "session";
  std::filesystem::create_directories(session / "export");
  UnsealOutput(session / "export");
  WriteFile(session / "export" / "trials.csv", "trial_id\n");
  SealOutput(session / "export", {"trials.csv"}, {});
  EXPECT_EQ(FindUnverified(session), Names());
  std::filesystem::remove(session / "export" / "manifest.json");
  const Names found = FindUnverified(session);
  EXPECT_NE(std::find(found.begin(), found.end(), "export/trials.csv"), found.end());
}

}  // namespace

}  // namespace graspbench
