#include "datasets/plan/session_keys.h"

#include <gtest/gtest.h>

#include "core/base/config.h"
#include "datasets/plan/session_config.h"

namespace graspbench {
namespace {

TEST(SessionKeysTest, NoKeyLacksItsLine) {
  const FileKeys& keys = ListSessionKeys();
  const std::vector<std::string> names = ListConfigKeys(SessionFile());
  ASSERT_EQ(keys.size(), names.size());
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(keys[i].key, names[i]);
    EXPECT_NE(keys[i].meaning, "") << names[i];
    EXPECT_EQ(keys[i].fallback.empty(), names[i] == "preset") << names[i];
  }
  const FileKey* step = FindFileKey(keys, "sim.step_s");
  ASSERT_NE(step, nullptr);
  EXPECT_EQ(step->fallback, "0.002");
  EXPECT_EQ(FormatRange(*step), "0.0001 to 0.01");
}

}  // namespace
}  // namespace graspbench
