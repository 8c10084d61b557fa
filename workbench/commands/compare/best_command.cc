#include <algorithm>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/best_grasps.h"
#include "workbench/command.h"
#include "workbench/tables/text_table.h"

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
    Json tied = Json::array();
    for (const CellSummary* cell : row.tied) tied.push_back(cell->grasp);
    list.push_back({{"hand", row.hand},
                    {"object", row.object},
                    {"tried", row.num_tried},
                    {"best", MakeChoiceJson(row.best)},
                    {"as_good", tied},
                    {"usual", MakeChoiceJson(row.usual)},
                    {"gain", {row.gain.low, row.gain.high}},
                    {"usual_is_worse", row.is_usual_worse()}});
  }
  return {{"objects", list}};
}

std::string DescribeRow(const BestGrasp& row) {
  if (row.num_tried == 1) return "only one tried";
  return row.is_usual_worse() ? "worse" : "";
}

std::string FormatChoices(const std::vector<BestGrasp>& rows) {
  TextTable table({"hand", "object", "tried", "best", "held", "95 % [%]", "same rate", "usual",
                   "held", "95 % [%]", ""});
  for (const BestGrasp& row : rows) {
    std::vector<std::string> cells = {row.hand, row.object, std::to_string(row.num_tried)};
    std::string tied;
    for (const CellSummary* cell : row.tied) tied += (tied.empty() ? "" : " ") + cell->grasp;
    const auto add = [&](const CellSummary* cell, const char* otherwise) {
      cells.insert(cells.end(), {cell ? cell->grasp : otherwise, cell ? FormatHeld(*cell) : "",
                                 cell ? FormatRateInterval(cell->tally) : ""});
    };
    add(row.best, "none held it");
    cells.push_back(tied);
    add(row.usual, "not tried");
    cells.push_back(DescribeRow(row));
    table.AddRow(cells);
  }
  const auto count = [&](auto is_counted) {
    return std::to_string(std::count_if(rows.begin(), rows.end(), is_counted));
  };
  const bool has_ties =
      std::any_of(rows.begin(), rows.end(), [](const BestGrasp& row) { return !row.tied.empty(); });
  return table.Format() + FormatCount(static_cast<int>(rows.size()), "object") +
         ": the default grasp has the best rate for " +
         count([](const BestGrasp& row) { return row.is_usual_as_good(); }) +
         ", is significantly worse on the same draws for " +
         count([](const BestGrasp& row) { return row.is_usual_worse(); }) + ", was not tried for " +
         count([](const BestGrasp& row) { return !row.usual; }) + "; no grasp succeeds for " +
         count([](const BestGrasp& row) { return !row.best; }) + "\n" +
         (has_ties ? "grasps with the same rate may differ in strength: graspbench judge DIR\n"
                   : "");
}

void FindBest(const BestOptions& options) {
  const Session session = LoadSession(options.session, OnDamage::kRefuse, RecordParts::kBrief);
  if (!session.config.conditions.empty()) {
    throw Error(ErrorKind::kUsage,
                "\"" + options.session +
                    "\" is a sweep; its report and export/effects.csv compare the conditions. "
                    "graspbench best needs a session without conditions");
  }
  const SessionSummary summary = SummariseSession(session);
  SessionConfig config = session.config;
  if (!HasBestGrasp(config)) config.grasps.push_back(kBestGrasp);
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater, options.session);
  const std::vector<BestGrasp> rows = FindBestGrasps(session, summary, inputs);
  const bool compares =
      std::any_of(rows.begin(), rows.end(), [](const BestGrasp& row) { return row.num_tried > 1; });
  if (!compares) {
    throw Error(ErrorKind::kUsage,
                "\"" + options.session +
                    "\" tried one grasp of each object, so there is nothing to compare; run a "
                    "session with --grasp all");
  }
  options.json ? PrintJson(MakeBestJson(rows)) : PrintResult(FormatChoices(rows));
}

}  // namespace

void AddBestCommand(Command& program) {
  Command& command = AddSubcommand(program, "best",
                                   "Compare the best grasp of each object with the default grasp.",
                                   "  graspbench run --grasp all --out results/all\n"
                                   "  graspbench best results/all");
  const auto options = std::make_shared<BestOptions>();
  command.AddRequired("session", options->session, "a session with several grasps", "DIR");
  AddJsonOption(command, options->json);
  command.SetAction([options] { FindBest(*options); });
}

}  // namespace graspbench
