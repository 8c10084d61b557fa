#include "datasets/campaign/merge_campaigns.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/campaign/fake_scene.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class MergeCampaignsTest : public testing::Test {
 protected:
  fs::path MakeScene(const std::string& name, const std::vector<double>& fitness,
                     bool is_finished = false) {
    WriteScene(top_.path() / name, "can", fitness, is_finished);
    return top_.path() / name;
  }
  /** Two scenes, of which `finished` is; "can" and "mug". */
  fs::path MakeCampaign(const std::string& name, const std::string& finished) {
    const fs::path folder = top_.path() / name;
    CreateCampaign(folder, CampaignConfig());
    for (const char* object : {"can", "mug"}) {
      WriteScene(folder / "scenes" / ("tum-" + std::string(object)), object, {1.0, 2.0},
                 object == finished);
    }
    SealStore(kCampaignStore, folder);
    return folder;
  }
  TemporaryFolder top_;
};

TEST_F(MergeCampaignsTest, TheLongerJournalAndTheResultAreTaken) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.0, 3.0}, true);
  EXPECT_EQ(MergeScenes(b, {a}), 0);
  EXPECT_EQ(MergeScenes(a, {b}), 1);
  EXPECT_TRUE(HasSceneResult(a));
  for (const char* file : {"journal.jsonl", "result.json", "manifest.json"}) {
    EXPECT_EQ(ReadFile(a / file), ReadFile(b / file)) << file;
  }
  EXPECT_EQ(MergeScenes(a, {b}), 0);
  EXPECT_TRUE(CheckStore(a).damages.empty());
}

TEST_F(MergeCampaignsTest, OtherAnswersAndOtherSettingsAreRefused) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.5, 3.0});
  const std::string before = ReadFile(a / "journal.jsonl");
  EXPECT_THROW(MergeScenes(a, {b}), Error);
  WriteScene(top_.path() / "c", "mug", {1.0, 2.0, 3.0}, false);
  EXPECT_THROW(MergeScenes(a, {top_.path() / "c"}), Error);
  EXPECT_THROW(MergeScenes(a, {top_.path() / "none"}), Error);
  EXPECT_EQ(ReadFile(a / "journal.jsonl"), before);
}

TEST_F(MergeCampaignsTest, ATornEndIsNoAnswer) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.0, 3.0});
  const std::string text = ReadFile(b / "journal.jsonl");
  WriteFile(b / "journal.jsonl", text.substr(0, text.size() - 5));
  EXPECT_EQ(MergeScenes(a, {b}), 0);
  EXPECT_EQ(MergeScenes(b, {a}), 0);
}

TEST_F(MergeCampaignsTest, ScenesSearchesAndWorkersComeTogether) {
  const fs::path a = MakeCampaign("a", "can"), b = MakeCampaign("b", "mug");
  WriteSearch(b / "comparison" / "tum-can" / "es-1.jsonl", {1.0, 2.0, 3.0});
  WorkerLog(b, "2of2").Append(WorkerStart{"2of2", "2026-01-31T12:00:00Z", {}, {}});
  EXPECT_EQ(MergeCampaigns(a, {b}), 3);
  EXPECT_EQ(MergeCampaigns(a, {b}), 0);
  for (const fs::path& scene : ListScenes(a)) EXPECT_TRUE(HasSceneResult(scene)) << scene;
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(a, findings).starts.size(), 1u);
  EXPECT_TRUE(CheckStore(a).damages.empty());
  CampaignConfig other;
  other.session.seed = 2;
  CreateCampaign(top_.path() / "c", other);
  EXPECT_THROW(MergeCampaigns(a, {top_.path() / "c"}), Error);
}

}  // namespace
}  // namespace graspbench
