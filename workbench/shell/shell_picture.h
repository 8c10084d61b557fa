#pragma once
/** @file
The scene as a picture, in a file or in the cells of a terminal. */

#include <memory>
#include <string>
#include <vector>

#include "core/render/scene.h"
#include "workbench/pictures/scene_view.h"
#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** How a terminal shows a picture. */
enum class PictureForm {
  kCharacters,  ///< without colour and without any escape sequence
  kBlocks,      ///< coloured
  kSixel,       ///< pixels
  kKitty        ///< pixels
};
/** The best one: pixels where the environment names a terminal that can, blocks on any other,
characters in a pipe, under NO_COLOR and in a dumb terminal. tmux and screen show blocks, whatever
they run in. @param environment  "NAME=value". */
PictureForm ChoosePictureForm(bool is_terminal, const std::vector<std::string>& environment);

/** Draws a scene repeatedly: meshes are uploaded once for each size of picture. */
class ScenePainter {
 public:
  /** @throws Error(kEnvironment) when the machine cannot draw. */
  Image Draw(ShellScene& scene, const SceneView& view, int width, int height,
             RenderQuality quality = RenderQuality::kFull);

  /** In the form that the terminal on stdout shows best, over its whole width. @throws as Draw. */
  std::string DrawForTerminal(ShellScene& scene, const SceneView& view);
  /** Lines for a StatusRegion: the same in blocks or characters, a column and `num_lines` lines
  smaller than the terminal. @throws as Draw. */
  std::vector<std::string> DrawLive(ShellScene& scene, const SceneView& view, int num_lines);

 private:
  std::string DrawCells(ShellScene& scene, const SceneView& view, PictureForm form, int columns,
                        int rows);

  struct Easel {
    std::unique_ptr<Renderer> renderer;
    int width = 0, height = 0;  // of its pictures
  };
  Easel full_, draft_;
};

/** One line of what is to be seen. */
std::string DescribeView(ShellScene& scene, const SceneView& view);

}  // namespace graspbench
