#include "reports/board_page.h"

#include <algorithm>

#include "core/base/text/text.h"
#include "datasets/session/find_trial.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/svg_plot.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {
namespace {

struct BoardPageData {
  const Board& board;
  bool has_trials;
  SessionModels models;
};

std::string LabelLine(const BoardLine& line) {
  return (line.rank ? std::to_string(*line.rank) + ". " : "") + line.entry->facts.name + ", " +
         line.hand;
}

std::string AnchorFailure(size_t line, const std::string& object) {
  return "failed-" + std::to_string(line) + "-" + object;
}

/** Returns the link to this line's trial on an object or to its failure; empty if there is none. */
std::string FindExample(const BoardPageData& data, size_t line, const std::string& object) {
  const BoardLine& of = data.board.lines[line];
  const auto example = of.examples.find(object);
  if (example == of.examples.end()) return {};
  if (data.has_trials) {
    return NameTrialsPage(data.board, of) + "#" + MakeViewAnchor(example->second->plan);
  }
  return IsSuccess(example->second->outcome) ? "" : AnchorFailure(line, object);
}

std::string DescribeDraws(const Board& board) {
  return board.held_out_seed ? "held-out draws of seed " + std::to_string(*board.held_out_seed) +
                                   ", revealed after the entries were packed"
                             : "the public draws, on which authors may have chosen their entries";
}

Html DrawRanks(const BoardPageData& data) {
  const Board& board = data.board;
  if (board.lines.empty()) return MakeParagraph("No entry has passed the checks.");
  const BoardLine& first = board.lines.front();
  std::string lead = "Best: " + LabelLine(first) + " with " + FormatRate(first.tally) + ". ";
  const auto tied = std::count_if(board.lines.begin(), board.lines.end(), [&](const auto& line) {
    return line.rank && first.rank && *line.rank == *first.rank;
  });
  if (tied > 1) {
    lead += FormatCount(tied - 1, "other line shares", "other lines share") +
            " its rank, because the 95 % interval of the paired difference includes 0. ";
  }
  return MakeParagraph(lead + "Ranks are by " + DescribeDraws(board) + ".") +
         MakeTable("Ranks of " + board.benchmark.name + ": one line per entry and hand.",
                   ShowTable(ListBoardColumns(), board.lines)) +
         MakeParagraph(
             "Every number is of trials that were simulated again for this page. A line shares the "
             "rank of the first line of that rank unless the 95 % interval of their paired "
             "difference excludes 0. Intervals are not corrected for the number of entries. Of "
             "many entries the best is partly luck.");
}

Html DrawMap(const BoardPageData& data) {
  const Board& board = data.board;
  if (board.lines.empty()) return MakeParagraph("There is nothing to show.");
  HeatMap map;
  map.text = {"Successes by entry and object",
              "A table of entries in rows and objects in columns; every cell gives successes and "
              "trials."};
  for (const std::string& object : board.objects) {
    map.columns.push_back(data.models.NameOfObject(object));
  }
  for (size_t i = 0; i < board.lines.size(); ++i) {
    const BoardLine& line = board.lines[i];
    map.rows.push_back(LabelLine(line));
    for (const std::string& object : board.objects) {
      HeatMap::Cell cell;
      const auto found = line.objects.find(object);
      if (found != line.objects.end()) {
        const Tally& tally = found->second;
        cell.rate = tally.rate();
        cell.text = std::to_string(tally.successes()) + " / " + std::to_string(tally.finished);
        cell.hint =
            LabelLine(line) + ", " + data.models.NameOfObject(object) + ": " + FormatRate(tally);
        cell.anchor = FindExample(data, i, object);
      }
      map.cells.push_back(cell);
    }
  }
  return MakeFigure(
      "Successes of every entry on every object.",
      std::string("columns that are weak with every entry, and entries that are weak "
                  "on few objects. ") +
          (data.has_trials ? "Each cell opens a trial on the public draws, in 3-D."
                           : "A cell with a failure leads to a failed trial of its own."),
      MakeScroll(map.text.title, DrawHeatMap(map)));
}

Html DrawWinners(const BoardPageData& data) {
  if (data.board.winners.empty() || data.board.lines.empty()) {
    return MakeParagraph("There is nothing to show.");
  }
  std::vector<GroupWinner> winners = data.board.winners;
  for (GroupWinner& winner : winners) {
    std::string names;
    for (const std::string& object : winner.objects) {
      names += (names.empty() ? "" : ", ") + data.models.NameOfObject(object);
    }
    if (winner.group == "least friction") winner.group = "slippery (least friction)";
    if (winner.objects.size() == 1) {
      winner.group = names;
    } else if (winner.objects.size() < data.board.objects.size()) {
      winner.group += ": " + names;
    }
  }
  return MakeParagraph(
             "Groups are thirds of the objects by their static friction and their mass; objects of "
             "equal value stay together. The objects with the least friction are the slippery "
             "ones. Sure: the 95 % interval of the paired difference between best and second "
             "excludes 0. With five objects or more the interval resamples the objects; with fewer "
             "it holds for these objects only. With many rows some are sure by chance.") +
         MakeTable("The best line on each group of objects and on each object.",
                   ShowTable(ListWinnerColumns(), winners));
}

Html DrawFailures(const BoardPageData& data) {
  const Board& board = data.board;
  StackedBars plot;
  plot.text = {"Outcomes by entry", "One bar per entry and hand, divided by outcome."};
  for (const Outcome outcome : ListOutcomes()) {
    plot.classes.push_back({WordsOf(outcome), CodeOf(outcome)});
  }
  Table table("A failed trial of each entry on each object, of the public draws.",
              {"Entry", "Hand", "Object", "Failed trial", "Ended as", "Pack"});
  const BoardTrial* first = nullptr;
  std::string pack;  // pack of the first trial
  for (size_t i = 0; i < board.lines.size(); ++i) {
    const BoardLine& line = board.lines[i];
    plot.rows.push_back(
        {LabelLine(line), {}, {line.tally.outcomes.begin(), line.tally.outcomes.end()}, false});
    for (const auto& [object, trial] : line.examples) {
      if (IsSuccess(trial->outcome)) continue;
      const std::string name = NameTrial(trial->plan);
      table.AddRow({line.entry->facts.name, line.hand, data.models.NameOfObject(object),
                    data.has_trials ? Element("a", {{"href", FindExample(data, i, object)}}, name)
                                    : Text(name),
                    WordsOf(trial->outcome), line.entry->pack},
                   AnchorFailure(i, object));
      if (!first) {
        first = trial;
        pack = line.entry->pack;
      }
    }
  }
  if (board.lines.empty()) return MakeParagraph("There is nothing to show.");
  const Html bars = MakeFigure("Outcomes of all trials that rank, by entry and hand.",
                               "one class of failure in many entries (the benchmark's difficulty) "
                               "against one in few (the entry's fault).",
                               MakeScroll(plot.text.title, DrawStackedBars(plot)));
  if (!first) return bars + MakeParagraph("No public trial of any entry failed.");
  return bars +
         MakeParagraph(
             "These commands repeat a trial from its pack, compare it with the entry's record, and "
             "make a page with the trial in 3-D. Run them in the folder that holds the pack. The "
             "table has the pack and the name of each trial. This is the first row; a trial takes "
             "up to a minute with its remedies:") +
         MakeScroll("Commands", Element("pre", {},
                                        "rm -rf entry && mkdir entry && tar xf " + pack +
                                            " -C entry\ngraspbench trial entry/session " +
                                            NameTrial(first->plan) + " --page trial.html")) +
         table.ToHtml();
}

/** Renders each line of the author's notes as a paragraph. */
Html DrawNotes(const std::string& notes) {
  Html paragraphs;
  for (size_t start = 0; start < notes.size();) {
    const size_t end = std::min(notes.find('\n', start), notes.size());
    if (end > start) paragraphs += MakeParagraph(notes.substr(start, end - start));
    start = end + 1;
  }
  return paragraphs;
}

Html DrawEntries(const BoardPageData& data) {
  if (data.board.entries.empty()) return MakeParagraph("There is nothing to show.");
  Table table("Entries and their packs.", {"Entry", "By", "Licence", "Pack", "SHA-256"});
  Html content;
  for (const BoardEntry& entry : data.board.entries) {
    const EntryFacts& facts = entry.facts;
    table.AddRow({facts.name, facts.by, facts.licence, entry.pack, entry.sha256});
    Html about;
    if (!entry.reproduction.first.empty()) {
      about += MakeParagraph(
          "First record that its trial does not give again, " + entry.reproduction.first +
          ". Another processor or an edited record can be the cause; the ranks use the trial as "
          "simulated again.");
    }
    about += Element("blockquote", {}, DrawNotes(facts.notes));
    content += MakeDetails("Method of " + facts.name + ", in its author's words", about);
  }
  return table.ToHtml() + content;
}

Html DrawRefused(const BoardPageData& data) {
  if (data.board.refused.empty()) return MakeParagraph("Every pack passed the checks.");
  return MakeTable("Packs without a rank, with the reason.",
                   ShowTable(ListRefusedColumns(), data.board.refused));
}

Html DrawRules(const BoardPageData& data) {
  const Benchmark& benchmark = data.board.benchmark;
  std::string open;
  for (const std::string& key : benchmark.open) open += (open.empty() ? "" : ", ") + key;
  Table pins("What entries have in common.", {"What", "Id", {"Hash", "of its content"}});
  pins.AddRow({"benchmark", benchmark.name, benchmark.sha256});
  for (const auto& [id, hash] : benchmark.hands) pins.AddRow({"hand, of choice", id, hash});
  for (const auto& [id, hash] : benchmark.objects) pins.AddRow({"object", id, hash});
  std::vector<std::string> limits = {
      "Found: changed bytes, missing or doubled trials, other seeds, settings, hands, objects or "
      "physics, records that do not follow from configuration and grasps, and results that repeat "
      "another entry's in every trial.",
      "Not found: grasps or controllers that were chosen on the public draws. Held-out draws show "
      "it, as public less held-out success.",
      "Not found: recorded actions that were computed with a knowledge of the object's pose that "
      "the entry does not declare. So sensing is declared, and recorded actions have no rank on "
      "held-out draws.",
      "Not checked: whether the author's words describe what was done."};
  if (data.board.held_out_seed) {
    limits.push_back("The held-out seed was checked against the commitment " +
                     data.board.commitment +
                     ". That it was published before the entries were packed is for readers to "
                     "check.");
  }
  return MakeParagraph(benchmark.about) +
         MakeParagraph("An entry may choose its hands among those below, and: " + open +
                       ". All else is as the configuration says. Physics version " +
                       std::to_string(benchmark.physics) + ".") +
         MakeList(limits) + pins.ToHtml() +
         MakeDetails("Configuration",
                     MakeConfigTable("Settings of the benchmark.", ToJson(benchmark.session)));
}

}  // namespace

std::string MakeBoardPage(const Board& board, bool has_trials) {
  BoardPageData data = {board, has_trials, {}};
  if (!board.lines.empty()) {
    const BoardDraws& draws = board.lines.front().entry->ranking();
    data.models = LoadSessionModels(draws.config, draws.folder);
  }
  const std::vector<PageSection<BoardPageData>> sections = {
      {"ranks", "Ranks", DrawRanks},
      {"map", "Success by object", DrawMap},
      {"winners", "Who is best where", DrawWinners},
      {"failures", "How trials failed", DrawFailures},
      {"entries", "Entries", DrawEntries},
      {"refused", "Without a rank", DrawRefused},
      {"rules", "Rules and limits", DrawRules}};
  PageFrame frame = {board.benchmark.name,
                     FormatCount(int64_t(board.entries.size()), "entry", "entries") + ", " +
                         FormatCount(int64_t(board.refused.size()), "pack") + " without a rank"};
  frame.commands = {"graspbench board PACK.. --benchmark " + board.benchmark.name + " --out DIR"};
  frame.references = {"wilson1927"};
  return MakeSectionedPage(frame, sections, data);
}

}  // namespace graspbench
