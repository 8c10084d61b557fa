#include "human_study/study/design/study_keys.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/config.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace {

TEST(StudyKeysTest, NoKeyLacksItsLine) {
  const FileKeys& keys = ListStudyKeys();
  const std::vector<std::string> names = ListConfigKeys(StudyConfig());
  ASSERT_EQ(keys.size(), names.size());
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(keys[i].key, names[i]);
    EXPECT_NE(keys[i].meaning, "") << names[i];
    EXPECT_NE(keys[i].fallback, "") << names[i];
  }
}

// What help says of a number's limits is what the reader keeps to.
TEST(StudyKeysTest, EveryLimitIsChecked) {
  int num_checked = 0;
  for (const FileKey& key : ListStudyKeys()) {
    if (!std::isfinite(key.low) || key.key.find("multiverse") == 0) continue;
    Diagnostics problems;
    ParseStudyConfig("markers: {thumb: t, index: i, object: o}\n", "study.yaml", problems,
                     {key.key + "=-1"});
    EXPECT_NE(
        problems.Format().find(key.key + ": -1 is out of range; expected " + FormatRange(key)),
        std::string::npos)
        << problems.Format();
    ++num_checked;
  }
  EXPECT_GT(num_checked, 30);
}

}  // namespace
}  // namespace graspbench
