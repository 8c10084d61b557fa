#include "datasets/session/ro_crate.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/version.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

class RoCrate : public testing::Test {
 protected:
  RoCrate() {
    const std::vector<PlannedTrial> plan = CreateFakeSession(folder_, 1);
    JournalWriter(folder_, 0).Append(MakeFakeRecord(plan[0]));
    SealStore(kSessionStore, folder_);
    ExportSession(folder_, LoadSession(folder_));
    WriteFile(folder_ / "run.json",
              R"({"runs":[{"started_utc":"2026-01-31T12:00:00Z","duration_s":1.5,"host":"secret",
                 "program_version":"0.1.0","build":"0123456789abcdef","workers":2,"trials":1,
                 "ending":"finished"}]})");
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "s";
};

TEST_F(RoCrate, IsAGraphWithoutLooseEnds) {
  const std::string text = FormatRoCrate(folder_);
  EXPECT_EQ(text.find("secret"), text.npos) << "the host";
  EXPECT_EQ(text.find(folder_.string()), text.npos);
  const Json crate = Json::parse(text);
  std::set<std::string> known, wanted;
  for (const Json& entity : crate["@graph"]) {
    EXPECT_TRUE(known.insert(entity["@id"].str()).second) << entity["@id"];
    EXPECT_TRUE(entity.contains("@type"));
    for (const auto& [key, value] : entity.items()) {
      for (const Json& one : value.is_array() ? value : Json::array({value})) {
        if (one.is_object()) wanted.insert(one["@id"].get<std::string>());
      }
    }
  }
  wanted.erase("https://w3id.org/ro/crate/1.1");
  for (const std::string& id : wanted) EXPECT_EQ(known.count(id), 1u) << id;
  EXPECT_EQ(crate["@context"], "https://w3id.org/ro/crate/1.1/context");
}

TEST_F(RoCrate, ItsFilesAreWhatTheySay) {
  int num_files = 0, num_actions = 0;
  const Json crate = Json::parse(FormatRoCrate(folder_));
  for (const Json& entity : crate["@graph"]) {
    num_actions += entity["@type"] == "CreateAction";
    if (entity["@type"] != "File") continue;
    const std::string bytes = ReadFile(folder_ / entity["@id"].get<std::string>());
    EXPECT_EQ(entity["sha256"], CalcSha256(bytes));
    EXPECT_EQ(entity["contentSize"], std::to_string(bytes.size()));
    ++num_files;
  }
  EXPECT_GE(num_files, 7);
  EXPECT_EQ(num_actions, 2) << "one run, one export";
}

TEST_F(RoCrate, ADamagedRunRecordIsNamed) {
  WriteFile(folder_ / "run.json", "{\"runs\":[{}]}");
  EXPECT_THROW(FormatRoCrate(folder_), Error);
  std::filesystem::remove(folder_ / "run.json");
  EXPECT_THROW(FormatRoCrate(folder_), Error);
}

TEST(Provenance, NamesTheSourcesOfAnOutput) {
  const TemporaryFolder folder;
  CreateFakeSession(folder.path(), 1);
  const ManifestOrigin origin =
      MakeOutputOrigin(folder.path(), "graspbench export .", {"plan.jsonl", "journal/*.jsonl"});
  ASSERT_EQ(origin.inputs.size(), 2u);
  EXPECT_EQ(origin.inputs[0].path, "../plan.jsonl");
  EXPECT_EQ(origin.inputs[0].sha256, CalcSha256(ReadFile(folder.path() / "plan.jsonl")));
  EXPECT_EQ(origin.inputs[1].path, "../journal/*.jsonl");
  EXPECT_TRUE(MakeOutputOrigin(folder.path() / "nowhere", "x").inputs.empty());
}

}  // namespace

}  // namespace graspbench
