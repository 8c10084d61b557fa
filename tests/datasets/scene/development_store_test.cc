#include "datasets/scene/development_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

DevelopmentRecord MakeDevelopmentRecord(int request) {
  return {request,
          "search",
          "0123456789abcdef",
          {{Outcome::kSuccess, 1.0 + 1.0 / (3.0 + request)}, {Outcome::kKnockedOver, 0.1}}};
}

TEST(DevelopmentLine, IsReadAsItWasWritten) {
  const std::string line = DevelopmentRecord::Format(MakeDevelopmentRecord(7));
  const DevelopmentRecord read = DevelopmentRecord::Parse(line);
  EXPECT_EQ(DevelopmentRecord::Format(read), line);
  EXPECT_EQ(read.trials[0].score, MakeDevelopmentRecord(7).trials[0].score);
  EXPECT_EQ(read.trials[1].outcome, Outcome::kKnockedOver);
}

TEST(DevelopmentStore, AnotherDevelopmentIsRefusedByName) {
  const TemporaryFolder folder;
  DevelopmentConfig config;
  config.hand = "tum";
  EXPECT_FALSE(HasDevelopment(folder.path()));
  CreateDevelopment(folder.path(), config);
  EXPECT_TRUE(HasDevelopment(folder.path()));
  CheckSameDevelopment(folder.path(), config);
  config.develop.seed = 2;
  EXPECT_TRUE(Throws([&] { CheckSameDevelopment(folder.path(), config); }, ErrorKind::kUsage,
                     "develop.seed: 1 and 2"));
}

}  // namespace
}  // namespace graspbench
