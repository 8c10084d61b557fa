#include "datasets/journal/store_kind.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(ListMatches, FindsNamesByPatternsOfOneStarAPart) {
  const TemporaryFolder folder;
  for (const char* name : {"a/1.jsonl", "a/2.jsonl", "a/2.jsonl.damaged", "b/1.jsonl", "1.jsonl",
                           "a/.3.jsonl", "a/deep/4.jsonl"}) {
    MakeFolder((folder.path() / name).parent_path());
    WriteFile(folder.path() / name, "");
  }
  using NameList = std::vector<std::string>;
  const auto list = [&](const NameList& patterns) { return ListMatches(folder.path(), patterns); };
  EXPECT_EQ(list({"a/*.jsonl"}), (NameList{"a/1.jsonl", "a/2.jsonl"}));
  EXPECT_EQ(list({"*/1.jsonl", "1.jsonl"}), (NameList{"1.jsonl", "a/1.jsonl", "b/1.jsonl"}));
  EXPECT_EQ(list({"*/*.jsonl", "a/1.jsonl"}), (NameList{"a/1.jsonl", "a/2.jsonl", "b/1.jsonl"}));
  EXPECT_EQ(list({"*"}), (NameList{"1.jsonl", "a", "b"}));
  EXPECT_EQ(list({"none/*", "c"}), NameList());
  for (const std::string& name : list({"*/*.jsonl"})) EXPECT_TRUE(IsMatch(name, {"*/*.jsonl"}));
  EXPECT_FALSE(IsMatch("a/deep/4.jsonl", {"*/*.jsonl", "*"}));
}

}  // namespace
}  // namespace graspbench
