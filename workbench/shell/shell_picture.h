#pragma once
/** @file
The scene as a picture, in a file or in the cells of a terminal. */

#include <memory>
#include <string>

#include "core/render/scene.h"
#include "workbench/scene_view.h"
#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** Draws a scene again and again: meshes are uploaded once for each size of picture. */
class ScenePainter {
 public:
  /** @throws Error(kEnvironment) when the machine cannot draw. */
  Image Draw(ShellScene& scene, const SceneView& view, int width, int height,
             RenderQuality quality = RenderQuality::kFull);

  /** In the form that the terminal on stdout shows best: pixels where it says that it can (kitty,
  sixel), else coloured blocks; characters without colour, and without any escape sequence, in a
  pipe, under NO_COLOR and in a dumb terminal. @throws as Draw. */
  std::string DrawForTerminal(ShellScene& scene, const SceneView& view);

 private:
  struct Easel {
    std::unique_ptr<Renderer> renderer;
    int width = 0, height = 0;  // of its pictures
  };
  Easel full_, draft_;
};

/** One line of what is to be seen. */
std::string DescribeView(ShellScene& scene, const SceneView& view);

}  // namespace graspbench
