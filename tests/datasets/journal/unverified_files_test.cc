#include "datasets/journal/unverified_files.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/files/files.h"
#include "datasets/journal/sealed_store.h"
#include "tests/datasets/journal/store_mutations.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

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
            "comparison.csv: cannot be verified, no hash of it is kept");
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
