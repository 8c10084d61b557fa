#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/hand/load_hand.h"
#include "tests/workbench/experiments/develop_gripper.h"

namespace graspbench {
namespace {

using DevelopHandSlow = DevelopHandTest;

TEST_F(DevelopHandSlow, AGripperGetsItsGraspsWhateverTheWorkersAndWhereverItStopped) {
  const std::vector<DevelopedGrasp> developed = Develop("one", 1);
  ASSERT_EQ(developed.size(), 3u);  // g2, g3, g4: with two digits
  const std::vector<Grasp> read = LoadStandardGrasps(LoadHand(out("one").string()));
  ASSERT_EQ(read.size(), 3u);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read[k].id, developed[k].grasp.id);
    EXPECT_EQ(read[k].q_target, developed[k].grasp.q_target);
  }
  const std::string yaml = ReadFile(out("one") / "hand.yaml");
  const std::string journal = ReadFile(out("one") / "development" / "journal.jsonl");
  const std::string result = ReadFile(out("one") / "development" / "result.json");

  // Stopped at once, then in the middle of a line, as by a kill.
  stop_ = true;
  EXPECT_THROW(Develop("two", 2), Error);
  stop_ = false;
  WriteFile(out("two") / "development" / "journal.jsonl", journal.substr(0, journal.size() / 2));
  Develop("two", 2);
  EXPECT_EQ(ReadFile(out("two") / "development" / "journal.jsonl"), journal);
  EXPECT_EQ(ReadFile(out("two") / "development" / "result.json"), result);
  EXPECT_EQ(ReadFile(out("two") / "hand.yaml"), yaml);
}

}  // namespace
}  // namespace graspbench
