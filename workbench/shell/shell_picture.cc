#include "workbench/shell/shell_picture.h"

#include <chafa.h>
#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "core/base/text/text.h"
#include "core/render/hand_scene.h"
#include "workbench/terminal/status_region.h"

namespace graspbench {
namespace {

/** In the gross motion of an arm. */
bool IsFar(ShellScene& scene) { return scene.notes().phase == Phase::kPreGrasp; }

Scene MakeSceneNow(ShellScene& scene) {
  const TrialSetup& setup = scene.setup();
  World& world = scene.course().world();
  Scene drawn = MakeGraspScene(setup.hand, world.state().q, world.state().X_WH, setup.object,
                               world.CalcObjectPose());
  AddArm(world.state().arm, world.state().q_arm, IsFar(scene), &drawn);
  return drawn;
}

template <class T, void (*kUnref)(T*)>
struct Unref {
  void operator()(T* object) const { kUnref(object); }
};
template <class T, void (*kUnref)(T*)>
using Chafa = std::unique_ptr<T, Unref<T, kUnref>>;

std::vector<std::string> ListEnvironment() {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry; ++entry) environment.emplace_back(*entry);
  return environment;
}

/** Empty: not set. */
std::string FindVariable(const std::vector<std::string>& environment, const std::string& name) {
  for (const std::string& entry : environment) {
    if (entry.compare(0, name.size() + 1, name + "=") == 0) return entry.substr(name.size() + 1);
  }
  return {};
}

/** What chafa knows of the terminal that the environment names. */
Chafa<ChafaTermInfo, chafa_term_info_unref> DetectTerminal(
    const std::vector<std::string>& environment) {
  std::vector<char*> entries;
  for (const std::string& entry : environment) entries.push_back(const_cast<char*>(entry.c_str()));
  entries.push_back(nullptr);
  return Chafa<ChafaTermInfo, chafa_term_info_unref>(
      chafa_term_db_detect(chafa_term_db_get_default(), entries.data()));
}

/** In pixels, of the picture that is drawn: a cell is twice as high as wide. */
struct CellSize {
  int width = 4, height = 8;
};

/** Of a terminal that shows pixels: its own, where it tells. */
CellSize FindPixelCell() {
  struct winsize size {};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0 ||
      size.ws_xpixel < size.ws_col || size.ws_ypixel < size.ws_row) {
    return {8, 16};
  }
  return {std::min(size.ws_xpixel / size.ws_col, 20), std::min(size.ws_ypixel / size.ws_row, 40)};
}

void SetCharacters(ChafaCanvasConfig* config, ChafaSymbolMap* symbols) {
  chafa_symbol_map_add_by_tags(symbols, CHAFA_SYMBOL_TAG_ASCII);
  chafa_canvas_config_set_canvas_mode(config, CHAFA_CANVAS_MODE_FGBG);
  chafa_canvas_config_set_fg_color(config, 0x000000);
  chafa_canvas_config_set_bg_color(config, 0xffffff);
  chafa_canvas_config_set_dither_mode(config, CHAFA_DITHER_MODE_DIFFUSION);
}

void SetColours(PictureForm form, const std::vector<std::string>& environment,
                ChafaCanvasConfig* config, ChafaSymbolMap* symbols) {
  chafa_symbol_map_add_by_tags(symbols, CHAFA_SYMBOL_TAG_BLOCK);
  chafa_symbol_map_add_by_tags(symbols, CHAFA_SYMBOL_TAG_SPACE);
  const std::string colours = FindVariable(environment, "COLORTERM");
  const bool has_all_colours = colours == "truecolor" || colours == "24bit";
  chafa_canvas_config_set_canvas_mode(
      config, has_all_colours ? CHAFA_CANVAS_MODE_TRUECOLOR : CHAFA_CANVAS_MODE_INDEXED_240);
  chafa_canvas_config_set_pixel_mode(config, form == PictureForm::kKitty ? CHAFA_PIXEL_MODE_KITTY
                                             : form == PictureForm::kSixel
                                                 ? CHAFA_PIXEL_MODE_SIXELS
                                                 : CHAFA_PIXEL_MODE_SYMBOLS);
}

}  // namespace

Image ScenePainter::Draw(ShellScene& scene, const SceneView& view, int width, int height,
                         RenderQuality quality) {
  const WorldState& state = scene.course().world().state();
  const Scene drawn = MakeSceneNow(scene);
  const Camera camera =
      PlaceCamera(view, {drawn}, *scene.setup().hand, state.q, state.X_WH,
                  IsFar(scene) ? state.arm : nullptr, static_cast<double>(width) / height);
  Easel& easel = quality == RenderQuality::kDraft ? draft_ : full_;
  if (!easel.renderer || width != easel.width || height != easel.height) {
    easel = {std::make_unique<Renderer>(width, height, quality), width, height};
  }
  return easel.renderer->Render(drawn, camera);
}

PictureForm ChoosePictureForm(bool is_terminal, const std::vector<std::string>& environment) {
  const std::string term = FindVariable(environment, "TERM");
  if (!is_terminal || term.empty() || term == "dumb" ||
      !FindVariable(environment, "NO_COLOR").empty()) {
    return PictureForm::kCharacters;
  }
  const bool is_inside_another = !FindVariable(environment, "TMUX").empty() ||
                                 term.rfind("tmux", 0) == 0 || term.rfind("screen", 0) == 0;
  if (is_inside_another) return PictureForm::kBlocks;
  const auto terminal = DetectTerminal(environment);
  const auto can = [&terminal](ChafaTermSeq sequence) {
    return chafa_term_info_have_seq(terminal.get(), sequence);
  };
  if (can(CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1)) return PictureForm::kKitty;
  return can(CHAFA_TERM_SEQ_BEGIN_SIXELS) ? PictureForm::kSixel : PictureForm::kBlocks;
}

std::string ScenePainter::DrawCells(ShellScene& scene, const SceneView& view, PictureForm form,
                                    int columns, int rows) {
  const bool has_pixels = form == PictureForm::kSixel || form == PictureForm::kKitty;
  const CellSize cell = has_pixels ? FindPixelCell() : CellSize();
  const Image image =
      Draw(scene, view, columns * cell.width, rows * cell.height, RenderQuality::kDraft);

  const Chafa<ChafaCanvasConfig, chafa_canvas_config_unref> config(chafa_canvas_config_new());
  chafa_canvas_config_set_geometry(config.get(), columns, rows);
  chafa_canvas_config_set_cell_geometry(config.get(), cell.width, cell.height);
  const Chafa<ChafaSymbolMap, chafa_symbol_map_unref> symbols(chafa_symbol_map_new());
  Chafa<ChafaTermInfo, chafa_term_info_unref> terminal(chafa_term_info_new());
  if (form == PictureForm::kCharacters) {
    SetCharacters(config.get(), symbols.get());
  } else {
    const std::vector<std::string> environment = ListEnvironment();
    terminal = DetectTerminal(environment);
    SetColours(form, environment, config.get(), symbols.get());
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

std::string ScenePainter::DrawForTerminal(ShellScene& scene, const SceneView& view) {
  const TerminalSize size = FindTerminalSize(stdout);
  // Two lines stay for the words below and the prompt.
  return DrawCells(scene, view, ChoosePictureForm(::isatty(STDOUT_FILENO), ListEnvironment()),
                   std::clamp(size.columns, 20, 200), std::clamp(size.rows - 2, 8, 60));
}

std::vector<std::string> ScenePainter::DrawLive(ShellScene& scene, const SceneView& view,
                                                int num_lines) {
  const TerminalSize size = FindTerminalSize(stdout);
  const PictureForm form = ChoosePictureForm(::isatty(STDOUT_FILENO), ListEnvironment());
  std::istringstream text(DrawCells(scene, view, std::min(form, PictureForm::kBlocks),
                                    std::clamp(size.columns - 1, 20, 200),
                                    std::clamp(size.rows - num_lines, 8, 60)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string DescribeView(ShellScene& scene, const SceneView& view) {
  const TrialSetup& setup = scene.setup();
  return fmt::format("{} with {}, {} view, {} at {} s\n", setup.hand->name, setup.object->name,
                     view.name, NameOf(scene.notes().phase), FormatFixed(scene.time(), 3));
}

}  // namespace graspbench
