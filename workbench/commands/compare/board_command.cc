#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "reports/board_page.h"
#include "workbench/command.h"
#include "workbench/experiments/board/run_board.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/result_page.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct BoardOptions {
  std::string benchmark = kDefaultBenchmark;
  std::vector<std::string> given;  ///< packs, or folders of them
  std::string out, work;
  int held_out_seed = 0;
  bool replace = false, json = false, with_scenes = false;
  BoardRequest request;
};

/** Of a folder its .tar files, by name. */
std::vector<fs::path> ListPacks(const std::vector<std::string>& given) {
  std::vector<fs::path> packs;
  for (const fs::path path : given) {
    if (!fs::exists(path)) throw Error(ErrorKind::kNotFound, "no file \"" + path.string() + "\"");
    if (!fs::is_directory(path)) {
      packs.push_back(path);
      continue;
    }
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(path)) {
      if (entry.path().extension() == ".tar") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    packs.insert(packs.end(), found.begin(), found.end());
  }
  if (packs.empty()) throw Error(ErrorKind::kUsage, "no pack (.tar) in the given folders");
  return packs;
}

Json MakeBoardJson(const Board& board) {
  return {{"benchmark", board.benchmark.name},
          {"benchmark_sha256", board.benchmark.sha256},
          {"held_out_seed", board.held_out_seed ? Json(*board.held_out_seed) : Json(nullptr)},
          {"lines", MakeJsonRows(ListBoardColumns(), board.lines)},
          {"winners", MakeJsonRows(ListWinnerColumns(), board.winners)},
          {"refused", MakeJsonRows(ListRefusedColumns(), board.refused)}};
}

ExitCode ShowBoard(const Command& command, BoardOptions& options) {
  BoardRequest& request = options.request;
  if (command.IsGiven("--held-out")) request.held_out_seed = options.held_out_seed;
  request.benchmark = LoadBenchmark(options.benchmark);
  request.packs = ListPacks(options.given);
  request.work = options.work.empty() ? options.out + "-work" : options.work;
  const OutputRequest output = {
      options.out, "board", options.replace, request.packs,
      "graspbench board PACK.. --benchmark " + request.benchmark.name + " --out DIR"};
  CheckOutputFolder(output);  // before an hour of simulation
  TerminalObserver observer(
      [](const Stage& stage) { return "simulated again: " + DescribeTasks(stage); });
  const Board board = RunBoard(request, observer);
  StagedFolder staged(output);
  WriteFile(staged.path() / "board.json", FormatJson(MakeBoardJson(board), 2) + "\n");
  WriteFile(staged.path() / "board.csv", FormatCsv(ListBoardColumns(), board.lines));
  WriteFile(staged.path() / "index.html", MakeBoardPage(board, options.with_scenes));
  for (const BoardLine& line : options.with_scenes ? board.lines : std::vector<BoardLine>()) {
    MakeFolder(staged.path() / kTrialPages);
    const Session session = LoadSession(line.entry->public_draws.folder);
    WriteFile(staged.path() / NameTrialsPage(board, line),
              MakeTrialsPage(board, line, MakeTrialTracer(session)));
  }
  staged.Commit();
  if (options.json) {
    PrintJson(MakeBoardJson(board));
  } else {
    std::string text = FormatTable(
        ShowTable(ListBoardColumns(), board.lines,
                  {"Rank", "Entry", "By", "Hand", "n", "Success [%]", "95 % interval [%]",
                   "Public less held-out [points]", "Records reproduced"}));
    for (const RefusedEntry& one : board.refused) {
      text += "no rank: " + one.pack + ": " + one.reason + "\n";
    }
    PrintResult(text + FormatPlaces(fs::path(options.out) / "index.html",
                                    fs::path(options.out) / "board.csv"));
  }
  return board.refused.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void AddBoardCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "board", "Check, simulate again and rank entries of a named benchmark on one page.",
      "  graspbench board mine.tar theirs.tar --out board   exit code 1 when one has no rank\n"
      "  graspbench board entries --out board --held-out 4711 --nonce TEXT --commitment SHA256");
  const auto options = std::make_shared<BoardOptions>();
  BoardRequest& request = options->request;
  command.AddRequired("packs", options->given, "packs of graspbench entry, or folders of them",
                      "PACK|DIR..");
  command
      .AddOption("--benchmark", options->benchmark, "a named benchmark, or its file", "NAME|FILE")
      ->Suggest(ListBenchmarks())
      ->ShowDefault();
  command.AddOption("--out", options->out, "folder of the page and its tables", "DIR")->Require();
  command
      .AddOption("--work", options->work, "folder that keeps what was simulated, for the next time",
                 "DIR")
      ->ShowDefault("that of --out with -work");
  Option* nonce =
      command.AddOption("--nonce", request.nonce, "what the seed was committed to with", "TEXT");
  Option* held_out =
      command.AddOption("--held-out", options->held_out_seed, "rank by draws of this seed", "SEED")
          ->Within(0, 2147483647)
          ->Needs(nonce);
  nonce->Needs(held_out);
  command
      .AddOption("--commitment", request.commitment,
                 "published before: SHA-256 of \"BENCHMARK SEED NONCE\"", "SHA256")
      ->ShowDefault("that of the benchmark");
  command.AddFlag("--judge", request.with_judge,
                  "break what the entries hold, too: breaking loads; some five times as long");
  command.AddFlag("--thresholds", request.with_thresholds,
                  "find each draw's smallest grip margin, too, but of recorded actions; some six "
                  "times as long");
  command.AddFlag("--3d", options->with_scenes,
                  "a trial of every entry, hand and object as a scene to turn and play");
  AddReplaceOption(command, options->replace);
  AddJobsOption(command, request.num_workers);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  AddJsonOption(command, options->json);
  command.SetAction([&command, options] { return ShowBoard(command, *options); });
}

}  // namespace graspbench
