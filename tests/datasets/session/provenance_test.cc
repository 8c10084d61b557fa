#include "datasets/session/provenance.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/base/sha256.h"
#include "core/base/version.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(Provenance, NamesTheProgram) {
  const ManifestOrigin origin = MakeOrigin("graspbench export .");
  EXPECT_EQ(origin.versions["program"], program_version());
  EXPECT_GE(origin.versions["physics"].get<int>(), 8);
  EXPECT_GE(origin.versions["judge"].get<int>(), 1);
  const auto commit = origin.versions["commit"].get<std::string>();
  EXPECT_TRUE(commit == "unknown" || commit.size() == 40u) << commit;
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
