#include "workbench/shell/shell_picture.h"

#include <chafa.h>
#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/render/hand_scene.h"

namespace graspbench {
namespace {

struct TerminalSize {
  int columns = 80, rows = 24;
};

TerminalSize FindTerminalSize() {
  struct winsize size {};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

bool IsPlain() {
  const char* term = std::getenv("TERM");
  const char* no_color = std::getenv("NO_COLOR");
  return !::isatty(STDOUT_FILENO) || !term || std::string(term) == "dumb" ||
         (no_color && *no_color);
}

template <class T, void (*kUnref)(T*)>
struct Unref {
  void operator()(T* object) const { kUnref(object); }
};
template <class T, void (*kUnref)(T*)>
using Chafa = std::unique_ptr<T, Unref<T, kUnref>>;

/** The best of what the terminal understands. */
void ChooseMode(ChafaTermInfo* terminal, ChafaCanvasConfig* config) {
  const char* colours = std::getenv("COLORTERM");
  const bool has_all_colours =
      colours && (std::string(colours) == "truecolor" || std::string(colours) == "24bit");
  const bool is_inside_tmux = std::getenv("TMUX") != nullptr;
  chafa_canvas_config_set_canvas_mode(
      config, has_all_colours ? CHAFA_CANVAS_MODE_TRUECOLOR : CHAFA_CANVAS_MODE_INDEXED_240);
  if (is_inside_tmux) return;
  if (chafa_term_info_have_seq(terminal, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1)) {
    chafa_canvas_config_set_pixel_mode(config, CHAFA_PIXEL_MODE_KITTY);
  } else if (chafa_term_info_have_seq(terminal, CHAFA_TERM_SEQ_BEGIN_SIXELS)) {
    chafa_canvas_config_set_pixel_mode(config, CHAFA_PIXEL_MODE_SIXELS);
  }
}

}  // namespace

Image ScenePainter::Draw(ShellScene& scene, const SceneView& view, int width, int height,
                         RenderQuality quality) {
  const TrialSetup& setup = scene.setup();
  World& world = scene.course().world();
  const Scene drawn = MakeGraspScene(setup.hand, world.state().q, world.state().X_WH, setup.object,
                                     world.CalcObjectPose());
  const Camera camera = PlaceCamera(view, {drawn}, *setup.hand, world.state().q, world.state().X_WH,
                                    static_cast<double>(width) / height);
  Easel& easel = quality == RenderQuality::kDraft ? draft_ : full_;
  if (!easel.renderer || width != easel.width || height != easel.height) {
    easel = {std::make_unique<Renderer>(width, height, quality), width, height};
  }
  return easel.renderer->Render(drawn, camera);
}

std::string ScenePainter::DrawForTerminal(ShellScene& scene, const SceneView& view) {
  const TerminalSize size = FindTerminalSize();
  // Two lines stay for the words below and the prompt; a cell is twice as high as wide.
  const int columns = std::clamp(size.columns, 20, 200), rows = std::clamp(size.rows - 2, 8, 60);
  constexpr int kCellWidth = 4, kCellHeight = 8;
  const Image image =
      Draw(scene, view, columns * kCellWidth, rows * kCellHeight, RenderQuality::kDraft);

  const Chafa<ChafaCanvasConfig, chafa_canvas_config_unref> config(chafa_canvas_config_new());
  chafa_canvas_config_set_geometry(config.get(), columns, rows);
  chafa_canvas_config_set_cell_geometry(config.get(), kCellWidth, kCellHeight);
  const Chafa<ChafaSymbolMap, chafa_symbol_map_unref> symbols(chafa_symbol_map_new());
  Chafa<ChafaTermInfo, chafa_term_info_unref> terminal(chafa_term_info_new());
  if (IsPlain()) {
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_ASCII);
    chafa_canvas_config_set_canvas_mode(config.get(), CHAFA_CANVAS_MODE_FGBG);
    chafa_canvas_config_set_fg_color(config.get(), 0x000000);
    chafa_canvas_config_set_bg_color(config.get(), 0xffffff);
    chafa_canvas_config_set_dither_mode(config.get(), CHAFA_DITHER_MODE_DIFFUSION);
  } else {
    char** environment = g_get_environ();
    terminal.reset(chafa_term_db_detect(chafa_term_db_get_default(), environment));
    g_strfreev(environment);
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_BLOCK);
    chafa_symbol_map_add_by_tags(symbols.get(), CHAFA_SYMBOL_TAG_SPACE);
    ChooseMode(terminal.get(), config.get());
  }
  chafa_canvas_config_set_symbol_map(config.get(), symbols.get());
  const Chafa<ChafaCanvas, chafa_canvas_unref> canvas(chafa_canvas_new(config.get()));
  chafa_canvas_draw_all_pixels(canvas.get(), CHAFA_PIXEL_RGB8, image.rgb.data(), image.width,
                               image.height, image.width * 3);
  GString* text = chafa_canvas_print(canvas.get(), terminal.get());
  std::string result(text->str, text->len);
  g_string_free(text, TRUE);
  return result + "\n";
}

std::string DescribeView(ShellScene& scene, const SceneView& view) {
  const TrialSetup& setup = scene.setup();
  return fmt::format("{} with {}, {} view, {} at {} s\n", setup.hand->name, setup.object->name,
                     view.name, NameOf(scene.notes().phase), FormatFixed(scene.time(), 3));
}

}  // namespace graspbench
