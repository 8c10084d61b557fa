#include "datasets/journal/read_journal.h"

#include <gtest/gtest.h>

#include <new>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

class ReadJournalTest : public testing::Test {
 protected:
  std::vector<int> Read(const std::string& text) {
    WriteFile(folder_.path() / "j.jsonl", text);
    std::vector<int> taken;
    const auto take = [&](const FileLine& line) {
      taken.push_back(ParseCheckedLine(line.text).at("a").get<int>());
    };
    ReadJournal(folder_.path(), "j.jsonl", take, findings_, damage_);
    return taken;
  }
  TemporaryFolder folder_;
  Diagnostics findings_;
  std::vector<Damage> damage_;
};

std::string Line(const Json& json) { return FormatCheckedLine(json) + "\n"; }

TEST_F(ReadJournalTest, EveryKindOfLineHasOneFate) {
  const std::string good = Line({{"a", 1}}), foreign = Line({{"b", 2}});
  std::string wrong = Line({{"a", 3}});
  wrong[5] = '4';
  EXPECT_EQ(Read(good + "\n" + wrong + foreign + Line({{"a", 5}}) + good.substr(0, 9)),
            (std::vector<int>{1, 5}));
  EXPECT_EQ(findings_.Format(),
            "j.jsonl:3: warning: skipped: its bytes do not match their checksum; it counts as not "
            "there\nj.jsonl:6: warning: the last line was not finished when the program stopped; "
            "it counts as not there");
  ASSERT_EQ(damage_.size(), 1u);
  EXPECT_EQ(damage_[0].path, "j.jsonl");
  EXPECT_EQ(damage_[0].line, 4);
}

TEST_F(ReadJournalTest, AGoodLineWithoutItsLineBreakWasNotFinished) {
  EXPECT_TRUE(Read(FormatCheckedLine({{"a", 1}})).empty());
  EXPECT_EQ(findings_.entries().size(), 1u);
  EXPECT_TRUE(damage_.empty());
}

TEST_F(ReadJournalTest, TooLittleMemoryIsNoFaultOfALine) {
  WriteFile(folder_.path() / "j.jsonl", Line({{"a", 1}}));
  const auto take = [](const FileLine&) { throw std::bad_alloc(); };
  EXPECT_THROW(ReadJournal(folder_.path(), "j.jsonl", take, findings_, damage_), std::bad_alloc);
}

TEST_F(ReadJournalTest, DamageIsRefusedUnlessItIsAccepted) {
  RefuseDamage("the search", folder_.path(), {}, OnDamage::kRefuse, "move it");
  const std::vector<Damage> damage = {{"j.jsonl", 4, "it is of another kind"}};
  RefuseDamage("the search", folder_.path(), damage, OnDamage::kAccept, "move it");
  try {
    RefuseDamage("the search", folder_.path(), damage, OnDamage::kRefuse, "move it");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    EXPECT_EQ(std::string(e.what()), "the search in \"" + folder_.path().string() +
                                         "\" holds what is not its own\n  j.jsonl:4: it is of "
                                         "another kind\nmove it");
  }
}

}  // namespace
}  // namespace graspbench
