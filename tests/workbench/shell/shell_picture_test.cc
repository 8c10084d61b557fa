#include "workbench/shell/shell_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace graspbench {
namespace {

TEST(ShellPicture, InAPipeIsPlainTextOfTheTerminalsSize) {
  ShellScene scene;
  scene.Choose(SceneChoice::MakeDefault());
  ScenePainter painter;
  testing::internal::CaptureStdout();  // no terminal, however the tests are run
  const std::string front = painter.DrawForTerminal(scene, ParseSceneView({"front"}, ""));
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(front.find('\033'), std::string::npos);
  EXPECT_TRUE(std::all_of(front.begin(), front.end(),
                          [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
  std::istringstream lines(front);
  size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 80u);
  EXPECT_EQ(count, 22u);
  EXPECT_GT(std::count_if(front.begin(), front.end(), [](char c) { return c > ' '; }), 100);
}

TEST(ShellPicture, ViewsDiffer) {
  ShellScene scene;
  scene.Choose(SceneChoice::MakeDefault());
  ScenePainter painter;
  std::vector<std::vector<uint8_t>> pictures;
  for (const std::string& name : ListSceneViews()) {
    if (name == "free") continue;
    const std::vector<uint8_t> picture =
        painter.Draw(scene, ParseSceneView({name}, ""), 64, 48).rgb;
    EXPECT_EQ(picture, painter.Draw(scene, ParseSceneView({name}, ""), 64, 48).rgb) << name;
    for (const auto& other : pictures) EXPECT_NE(picture, other) << name;
    pictures.push_back(picture);
  }
}

TEST(ShellPicture, PixelsOnlyWhereTheTerminalSaysSo) {
  const auto choose = [](const std::vector<std::string>& environment) {
    return ChoosePictureForm(true, environment);
  };
  using Form = PictureForm;
  EXPECT_EQ(choose({"TERM=xterm-256color", "COLORTERM=truecolor"}), Form::kBlocks);
  EXPECT_EQ(choose({"TERM=xterm-kitty"}), Form::kKitty);
  EXPECT_EQ(choose({"TERM=foot"}), Form::kSixel);
  EXPECT_EQ(choose({"TERM=mlterm", "MLTERM=3.9.0"}), Form::kSixel);
  EXPECT_EQ(choose({"TERM=tmux-256color", "TMUX=/tmp/tmux-0/default,1,0", "KITTY_PID=7"}),
            Form::kBlocks);
  EXPECT_EQ(choose({"TERM=screen-256color", "MLTERM=3.9.0"}), Form::kBlocks);
  EXPECT_EQ(choose({"TERM=xterm-kitty", "NO_COLOR=1"}), Form::kCharacters);
  EXPECT_EQ(choose({"TERM=xterm-kitty", "NO_COLOR="}), Form::kKitty);
  EXPECT_EQ(choose({"TERM=dumb"}), Form::kCharacters);
  EXPECT_EQ(choose({}), Form::kCharacters);
  EXPECT_EQ(ChoosePictureForm(false, {"TERM=xterm-kitty"}), Form::kCharacters);
}

}  // namespace
}  // namespace graspbench
