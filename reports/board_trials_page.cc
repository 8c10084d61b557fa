#include <algorithm>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/session/find_trial.h"
#include "reports/board_page.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/scenes/scene_3d.h"

namespace graspbench {
namespace {

Html DrawTrial(const BoardLine& line, const BoardTrial& trial, const SessionModels& models,
               const TrialTracer& trace, TrialViews& views) {
  const std::string name = models.NameOfObject(trial.plan.object) + ": " + WordsOf(trial.outcome) +
                           ", trial " + NameTrial(trial.plan);
  const auto hand = models.FindHand(line.hand);
  const auto object = models.FindObject(trial.plan.object);
  if (!hand || !object) return MakeParagraph(name + " has no model to be shown.");
  try {
    return MakeDetails(
        name, views.Add({hand, object, trace(trial.plan), MakeViewAnchor(trial.plan), name}));
  } catch (const Error& fault) {
    return MakeDetails(name, MakeNote("warning", "No course", MakeParagraph(fault.what())));
  }
}

}  // namespace

std::string NameTrialsPage(const Board& board, const BoardLine& line) {
  const auto is_same = [&](const BoardLine& other) {
    return other.entry == line.entry && other.hand == line.hand;
  };
  const auto place = std::find_if(board.lines.begin(), board.lines.end(), is_same);
  return std::string(kTrialPages) + "/" + std::to_string(place - board.lines.begin()) + ".html";
}

std::string MakeTrialsPage(const Board& board, const BoardLine& line, const TrialTracer& trace) {
  const BoardDraws& draws = line.entry->public_draws;
  const SessionModels models = LoadSessionModels(draws.config, draws.folder);
  TrialViews views;
  Html list = MakeParagraph(
      "Of each object the first failed trial on the public draws, else the first trial. With "
      "scripts a button opens the scene, to turn and to play.");
  for (const auto& [object, trial] : line.examples) {
    list += DrawTrial(line, *trial, models, trace, views);
  }
  Html body = Element("section", {{"id", "trials"}},
                      Element("h2", {}, "Trials by object") + list + views.MakeModels());
  PageFrame frame = {line.entry->facts.name + ", " + line.hand, board.benchmark.name};
  frame.commands = {"graspbench board PACK.. --benchmark " + board.benchmark.name +
                    " --3d --out DIR"};
  return AddScript(MakePage(frame, {{"trials", "Trials by object"}}, std::move(body)),
                   views.MakeScript());
}

}  // namespace graspbench
