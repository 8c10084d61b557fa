#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>

#include "core/base/text.h"
#include "datasets/analysis/best_grasps.h"
#include "workbench/commands/command.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

struct BestOptions {
  std::string session;
  bool json = false;
};

std::string FormatHeld(const CellSummary& cell) {
  return std::to_string(cell.tally.successes()) + " of " + std::to_string(cell.tally.finished);
}

Json MakeChoiceJson(const CellSummary* cell) {
  if (!cell) return Json();
  const Interval interval = cell->tally.rate_interval();
  return {{"grasp", cell->grasp},
          {"successes", cell->tally.successes()},
          {"trials", cell->tally.finished},
          {"interval", {interval.low, interval.high}}};
}

Json MakeBestJson(const std::vector<BestGrasp>& rows) {
  Json list = Json::array();
  for (const BestGrasp& row : rows) {
    list.push_back({{"hand", row.best->hand},
                    {"object", row.best->object},
                    {"best", MakeChoiceJson(row.best)},
                    {"usual", MakeChoiceJson(row.usual)},
                    {"gain", {row.gain.low, row.gain.high}},
                    {"usual_is_worse", row.is_usual_worse()}});
  }
  return {{"objects", list}};
}

std::string FormatChoices(const std::vector<BestGrasp>& rows) {
  TextTable table({"hand", "object", "best", "held", "95 % [%]", "usual", "held", "95 % [%]", ""});
  for (const BestGrasp& row : rows) {
    std::vector<std::string> cells = {row.best->hand, row.best->object, row.best->grasp,
                                      FormatHeld(*row.best), FormatRateInterval(row.best->tally)};
    if (row.usual) {
      cells.insert(cells.end(),
                   {row.usual->grasp, FormatHeld(*row.usual), FormatRateInterval(row.usual->tally),
                    row.is_usual_worse() ? "worse" : ""});
    } else {
      cells.insert(cells.end(), {"not tried", "", "", ""});
    }
    table.AddRow(cells);
  }
  const auto count = [&](auto is_counted) {
    return std::to_string(std::count_if(rows.begin(), rows.end(), is_counted));
  };
  return table.Format() + "the usual grasp is the best found for " +
         count([](const BestGrasp& row) { return row.usual == row.best; }) + " of " +
         std::to_string(rows.size()) + ", worse on the same draws beyond chance for " +
         count([](const BestGrasp& row) { return row.is_usual_worse(); }) + "\n";
}

void FindBest(const BestOptions& options) {
  const Session session = LoadSession(options.session, OnDamage::kRefuse, RecordParts::kBrief);
  const SessionSummary summary = SummariseSession(session);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, options.session);
  const std::vector<BestGrasp> rows = FindBestGrasps(session, summary, inputs);
  options.json ? PrintJson(MakeBestJson(rows)) : PrintResult(FormatChoices(rows));
}

}  // namespace

void AddBestCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "best", "Compare each object's best grasp with the usual one, from a session.",
      "  graspbench run --grasp all --out results/all\n"
      "  graspbench best results/all");
  const auto options = std::make_shared<BestOptions>();
  command.add_option("session", options->session, "a session with several grasps")
      ->required()
      ->option_text("DIR");
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options] { FindBest(*options); });
}

}  // namespace graspbench
