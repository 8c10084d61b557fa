#include "workbench/shell/shell.h"

#include <gtest/gtest.h>
#include <signal.h>

#include "core/base/text/text.h"
#include "core/grasp/placement.h"
#include "tests/workbench/shell/shell_fuzz.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

/** A shell whose words nobody reads. */
class ShellTest : public testing::Test {
 protected:
  std::string Describe() { return DescribeShell(shell_); }

  Silence silence_;
  Shell shell_;
};

TEST_F(ShellTest, UndoTakesEveryChangeBack) {
  const std::string start = Describe();
  const Names lines = {"object can",      "draw 2",        "move 5 5",
                       "turn 10",         "joint FFq2 30", "set seed 7",
                       "move hand 1 2 3", "turn hand y 5", "drive FFq2 10"};
  for (const std::string& line : lines) {
    EXPECT_EQ(shell_.Execute(line), Shell::Reply::kDone) << line;
  }
  EXPECT_EQ(shell_.num_changes(), static_cast<int>(lines.size()));
  for (size_t i = 0; i < lines.size(); ++i) shell_.Execute("undo");
  EXPECT_EQ(Describe(), start);
  EXPECT_EQ(shell_.Execute("undo"), Shell::Reply::kRefused);
}

TEST_F(ShellTest, RedoTakesEveryUndoBack) {
  EXPECT_EQ(shell_.Execute("redo"), Shell::Reply::kRefused);
  for (const char* line : {"draw 2", "joint FFq2 30", "goto 0.3"}) shell_.Execute(line);
  const std::string changed = Describe();
  shell_.Execute("undo");
  shell_.Execute("undo");
  EXPECT_NE(Describe(), changed);
  EXPECT_EQ(shell_.Execute("redo"), Shell::Reply::kDone);
  EXPECT_EQ(shell_.Execute("redo"), Shell::Reply::kDone);
  EXPECT_EQ(Describe(), changed);
  shell_.Execute("undo");
  shell_.Execute("draw 5");  // from here on there is another future
  EXPECT_EQ(shell_.Execute("redo"), Shell::Reply::kRefused);
}

TEST(ShellSignals, AnIgnoredSignalStaysIgnored) {
  ::signal(SIGHUP, SIG_IGN);
  CatchShellSignals();
  ::raise(SIGHUP);
  EXPECT_FALSE(MustShellEnd());
  ::raise(SIGINT);
  EXPECT_TRUE(TakeShellInterrupt());
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) {
    ::signal(signal, SIG_DFL);
  }
}

TEST_F(ShellTest, ThePromptSaysWhatIsChosenAndWhen) {
  EXPECT_EQ(FormatPrompt(shell_), "tum golf_ball best> ");
  shell_.Execute("goto 0.1");
  EXPECT_EQ(FormatPrompt(shell_), "tum golf_ball g6, placing 0.100 s> ");
  shell_.Execute("draw 2");
  EXPECT_EQ(FormatPrompt(shell_), "tum golf_ball g6, placing 0.000 s, 1 change> ");
}

TEST_F(ShellTest, ASettingTakesItsUnit) {
  EXPECT_EQ(shell_.Execute("set sim.step_s 0.002s"), Shell::Reply::kDone);
  EXPECT_EQ(shell_.choice().config.sim.step, 0.002);
  EXPECT_EQ(shell_.Execute("set sim.step_s 0.004mm"), Shell::Reply::kRefused);
  EXPECT_EQ(shell_.Execute("set sim.step_s s"), Shell::Reply::kRefused);
  EXPECT_EQ(shell_.choice().config.sim.step, 0.002);
}

TEST_F(ShellTest, TrialsCompareWithTheSceneBeforeItsChanges) {
  MakeCheap(shell_);
  shell_.Execute("hand shadow");
  EXPECT_EQ(shell_.Execute("trials 2"), Shell::Reply::kDone);
  EXPECT_EQ(shell_.comparison.find("against"), std::string::npos) << "nothing was changed";
  shell_.Execute("object can");
  EXPECT_EQ(shell_.Execute("joint FFJ3 30"), Shell::Reply::kDone);
  EXPECT_EQ(shell_.Execute("trials 2"), Shell::Reply::kDone);
  EXPECT_NE(shell_.comparison.find("on 2 same draws"), std::string::npos) << shell_.comparison;
}

TEST_F(ShellTest, RunAllPlaysEveryObjectAndComesBack) {
  MakeCheap(shell_);
  shell_.Execute("joint FFq2 -10");
  shell_.Execute("goto 0.2");
  const std::string before = Describe();
  testing::internal::CaptureStdout();
  EXPECT_EQ(shell_.Execute("run all to closure"), Shell::Reply::kDone);
  const std::string text = testing::internal::GetCapturedStdout();
  size_t num_objects = 0;  // a line each, and another where a trial ends before
  for (size_t at = text.find(" contacts\n"); at != std::string::npos; ++num_objects) {
    at = text.find(" contacts\n", at + 1);
  }
  EXPECT_EQ(num_objects, 21u) << text;
  EXPECT_NE(text.find("pencil"), std::string::npos);
  EXPECT_EQ(Describe(), before);
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

// Degrees of a limit in radians may end a bit beyond it.
TEST_F(ShellTest, AJointTakesItsLimitsAsTheyArePrinted) {
  shell_.Execute("hand shadow");
  const Hand hand = *shell_.scene().setup().hand;
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to >= 0) continue;
    for (const double limit : {joint.lower, joint.upper}) {
      const std::string line =
          "joint " + joint.name + " " + FormatFixed(ToDisplayUnits(joint, limit), 1);
      EXPECT_EQ(shell_.Execute(line), Shell::Reply::kDone) << line;
      const Eigen::VectorXd& q = shell_.scene().setup().grasp.q_target;
      EXPECT_LE(q[hand.FindJoint(joint.name)], joint.upper);
      EXPECT_GE(q[hand.FindJoint(joint.name)], joint.lower);
    }
  }
}

// GRASPBENCH_NUM_LINES=1000000 in the environment asks for more than the thousands of every run.
TEST_F(ShellTest, RefusedLinesChangeNothing) {
  const char* asked = std::getenv("GRASPBENCH_NUM_LINES");
  const int num_lines = asked ? std::stoi(asked) : 10000;
  const FuzzCount count = FuzzShell(shell_, asked ? "million" : "thousands", num_lines);
  EXPECT_GT(count.num_refused, num_lines / 2);
  EXPECT_GT(count.num_done, num_lines / 20);
}

TEST_F(ShellTest, ADriveGoesWhereItIsAsked) {
  shell_.Execute("goto 0.3");
  const int joint = shell_.scene().setup().hand->FindJoint("FFq2");
  const auto angle = [&] { return shell_.scene().course().world().state().q[joint]; };
  const double then = angle();
  EXPECT_EQ(shell_.Execute("drive FFq2 70"), Shell::Reply::kDone);
  EXPECT_EQ(angle(), then);  // up to now nothing is different
  shell_.Execute("goto 0.9");
  EXPECT_NEAR(shell_.scene().notes().command.q[joint], 70.0 * M_PI / 180.0, 1e-9);
  const double driven = angle();
  EXPECT_GT(driven, then + 0.3);
  shell_.Execute("undo");
  EXPECT_LT(angle(), driven - 0.1);
  EXPECT_EQ(shell_.Execute("drive FFq4 10"), Shell::Reply::kRefused);  // it follows
}

TEST_F(ShellTest, TheHandStandsWhereItIsPut) {
  const Pose X_WH = shell_.scene().course().world().state().X_WH;
  EXPECT_EQ(shell_.Execute("move hand 4 -5 6"), Shell::Reply::kDone);
  shell_.Execute("goto 0.6");
  const Eigen::Vector3d moved = shell_.scene().setup().grasp.placement->X_WH.translation();
  shell_.Execute("undo");
  const Placement before = CalcPlacement(*shell_.scene().setup().hand, shell_.scene().setup().grasp,
                                         *shell_.scene().setup().object);
  EXPECT_LT((moved - before.X_WH.translation() - Eigen::Vector3d(0.004, -0.005, 0.006)).norm(),
            1e-12);
  // A quarter about z through the object's middle takes x to y.
  shell_.Execute("turn hand z 90");
  const Placement turned = *shell_.scene().setup().grasp.placement;
  const Eigen::Vector3d p = before.X_WH.translation(), q = turned.X_WH.translation();
  EXPECT_LT((q - Eigen::Vector3d(-p.y(), p.x(), p.z())).norm(), 1e-12);
  EXPECT_LT((turned.X_WH.linear().col(0) - Eigen::Vector3d(-before.X_WH.linear()(1, 0),
                                                           before.X_WH.linear()(0, 0),
                                                           before.X_WH.linear()(2, 0)))
                .norm(),
            1e-12);
  EXPECT_NE(X_WH.matrix(), shell_.scene().course().world().state().X_WH.matrix());
}

}  // namespace
}  // namespace graspbench
