#include <gtest/gtest.h>

#include "tests/datasets/journal/store_mutations.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(StoreMutationsSlow, TenThousandAreFoundAndLoseNoWholeLine) {
  const TemporaryFolder folder;
  const MutationCount count = MutateStores(folder.path(), "ten thousand", 10000);
  std::printf("%d mutations, %d undetected, %d with lost records\n", count.mutations,
              count.undetected, count.records_lost);
  EXPECT_EQ(count.examples, "");
  EXPECT_EQ(count.mutations, 10000);
}

}  // namespace
}  // namespace graspbench
