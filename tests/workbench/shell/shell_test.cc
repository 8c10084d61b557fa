#include "workbench/shell/shell.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

/** A shell whose words nobody reads. */
class ShellTest : public testing::Test {
 protected:
  ShellTest() {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
  }
  ~ShellTest() override {
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
  }
  /** All that a command can change. */
  Json Describe() {
    const SceneChoice& choice = shell_.scene().choice();
    Json joints = Json::array();
    for (const JointEdit& edit : choice.joints) joints.push_back({edit.joint, edit.position});
    return {ToJson(choice.config), choice.draw.value_or(-1), choice.place.has_value(), joints,
            shell_.scene().time(), shell_.num_changes()};
  }

  Shell shell_;
};

TEST_F(ShellTest, UndoTakesEveryChangeBack) {
  const Json start = Describe();
  const Names lines = {"object can", "draw 2",        "move 5 5",
                       "turn 10",    "joint FFq2 30", "set seed 7"};
  for (const std::string& line : lines) {
    EXPECT_EQ(shell_.Execute(line), Shell::Reply::kDone) << line;
  }
  EXPECT_EQ(shell_.num_changes(), static_cast<int>(lines.size()));
  for (size_t i = 0; i < lines.size(); ++i) shell_.Execute("undo");
  EXPECT_EQ(Describe(), start);
  EXPECT_EQ(shell_.Execute("undo"), Shell::Reply::kRefused);
}

TEST_F(ShellTest, UndoStandsAtTheSameTime) {
  shell_.Execute("goto 0.7");
  const double time = shell_.scene().time();
  const Eigen::VectorXd q = shell_.scene().course().world().state().q;
  shell_.Execute("set model.mass_scale 2");
  EXPECT_EQ(shell_.scene().time(), 0.0);
  shell_.Execute("goto 0.7");
  shell_.Execute("undo");
  EXPECT_EQ(shell_.scene().time(), time);
  EXPECT_EQ(shell_.scene().course().world().state().q, q);
}

TEST_F(ShellTest, RefusedLinesChangeNothing) {
  const Names words = {"hand",    "object", "grasp", "draw",     "move",       "turn", "joint",
                       "set",     "open",   "goto",  "run",      "step",       "back", "view",
                       "shot",    "save",   "FFq2",  "can",      "g9",         "-1",   "1e308",
                       "nan",     "to",     "slip",  "'",        "\"",         "#",    "free",
                       "12.5deg", "5",      "x.png", "/nowhere", "sim.step_s", "seed", "\xff\xfe",
                       "\x1b[2J", "none",   "quit!", ";",        "%s%n"};
  RandomStream random("shell", "lines");
  int num_refused = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string line;
    const int count = 1 + static_cast<int>(random.NextUniform(0.0, 4.0));
    for (int w = 0; w < count; ++w) {
      const auto index = static_cast<size_t>(random.NextUniform(0.0, 1.0) * words.size());
      line += words[index] + " ";
    }
    // Pictures and files are tried elsewhere.
    if (line.rfind("view", 0) == 0 || line.rfind("shot", 0) == 0) continue;
    const Json before = Describe();
    const Shell::Reply reply = shell_.Execute(line);
    EXPECT_NE(reply, Shell::Reply::kQuit) << line;
    if (reply != Shell::Reply::kRefused) continue;
    ++num_refused;
    EXPECT_EQ(Describe(), before) << line;
  }
  EXPECT_GT(num_refused, 700);
}

}  // namespace
}  // namespace graspbench
