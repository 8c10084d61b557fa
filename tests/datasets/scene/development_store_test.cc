#include "datasets/scene/development_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
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

TEST(DevelopmentLine, DamageIsTold) {
  std::string line = DevelopmentRecord::Format(MakeDevelopmentRecord(7));
  line[20] ^= 1;
  EXPECT_THROW(DevelopmentRecord::Parse(line), Error);
}

class DevelopmentStoreTest : public testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "journal.jsonl"; }

  std::string Finish() {
    DevelopmentJournal journal(path());
    for (int request = 0; request < 10; ++request) {
      if (const DevelopmentRecord* stored = journal.Find(request)) {
        EXPECT_EQ(stored->request, request);
      } else {
        journal.Append({MakeDevelopmentRecord(request)});
      }
    }
    return ReadFile(path());
  }

  TemporaryFolder folder_;
};

TEST_F(DevelopmentStoreTest, IsContinuedWithTheSameBytesFromWhereverItWasCut) {
  const std::string whole = Finish();
  EXPECT_EQ(Finish(), whole);
  for (size_t length = 0; length < whole.size(); length += 61) {
    WriteFileAtomically(path(), whole.substr(0, length));
    ASSERT_EQ(Finish(), whole) << length;
  }
}

// As a repair leaves it when one line was damaged: the others are neither lost nor asked again.
TEST_F(DevelopmentStoreTest, ALineThatIsMissingCostsNoOther) {
  const std::string whole = Finish();
  const size_t second = whole.find('\n') + 1, third = whole.find('\n', second) + 1;
  WriteFileAtomically(path(), whole.substr(0, second) + whole.substr(third));
  EXPECT_EQ(Finish(),
            whole.substr(0, second) + whole.substr(third) + whole.substr(second, third - second));
}

TEST_F(DevelopmentStoreTest, AnotherDevelopmentIsRefusedByName) {
  DevelopmentConfig config;
  config.hand = "tum";
  EXPECT_FALSE(HasDevelopment(folder_.path()));
  CreateDevelopment(folder_.path(), config);
  EXPECT_TRUE(HasDevelopment(folder_.path()));
  CheckSameDevelopment(folder_.path(), config);
  config.develop.seed = 2;
  try {
    CheckSameDevelopment(folder_.path(), config);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(e.what()).find("develop.seed: 1 and 2"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace graspbench
