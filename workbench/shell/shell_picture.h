#pragma once
/** @file
Pictures of the scene, for files or for the terminal. */

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
/** Chooses the best form: pixels where the environment names a terminal that supports them, blocks
on any other. Pipes, NO_COLOR and dumb terminals get characters. tmux and screen get blocks,
whatever terminal they run in. @param environment  "NAME=value". */
PictureForm ChoosePictureForm(bool is_terminal, const std::vector<std::string>& environment);

/** Draws a scene repeatedly: meshes are uploaded once for each size of picture. */
class ScenePainter {
 public:
  /** @throws Error(kEnvironment) when the machine cannot draw. */
  Image Draw(ShellScene& scene, const SceneView& view, int width, int height,
             RenderQuality quality = RenderQuality::kFull);

  /** Draws in the best form of the terminal on stdout, over its whole width. @throws as Draw. */
  std::string DrawForTerminal(ShellScene& scene, const SceneView& view);
  /** Draws lines for a StatusRegion, in blocks or characters, one column and `num_lines` lines
  smaller than the terminal. @throws as Draw. */
  std::vector<std::string> DrawLive(ShellScene& scene, const SceneView& view, int num_lines);

 private:
  std::string DrawCells(ShellScene& scene, const SceneView& view, PictureForm form, int columns,
                        int rows);

  struct Easel {
    std::unique_ptr<Renderer> renderer;
    int width = 0, height = 0;  // of the pictures
  };
  Easel full_, draft_;
};

/** Describes the view in one line. */
std::string DescribeView(ShellScene& scene, const SceneView& view);

}  // namespace graspbench
