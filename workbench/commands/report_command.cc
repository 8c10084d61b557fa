#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "datasets/campaign/campaign_store.h"
#include "datasets/session/session_store.h"
#include "reports/campaign/campaign_report.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

struct ReportOptions {
  std::filesystem::path folder;
  std::filesystem::path out;  ///< empty: the result's own folder
  bool replace = false;
  OnDamage on_damage = OnDamage::kRefuse;
};

/** Writes the page of the result in options.folder below `place`. @returns its path from there. */
std::filesystem::path WriteReport(const ReportOptions& options,
                                  const std::filesystem::path& place) {
  const auto report_damage = [](const std::vector<Damage>& damage) {
    if (!damage.empty()) PrintMessage("damage accepted" + FormatDamage(damage));
  };
  if (HasCampaign(options.folder)) {
    const Campaign campaign = LoadCampaign(options.folder, options.on_damage);
    report_damage(campaign.damage);
    return WriteCampaignReport(place, campaign).lexically_relative(place);
  }
  Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  report_damage(session.damage);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  return WriteSessionReport(place, std::move(session)).lexically_relative(place);
}

void Report(const ReportOptions& options) {
  if (options.out.empty()) {
    PrintResult((options.folder / WriteReport(options, options.folder)).string() + "\n");
    return;
  }
  StagedFolder staged({options.out, "report", options.replace, {options.folder}});
  const std::filesystem::path page = WriteReport(options, staged.path());
  staged.Commit();
  PrintResult((options.out / page).string() + "\n");
}

}  // namespace

void AddReportCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(program, "report",
                                    "Write the report of a session or a campaign, finished or not.",
                                    "  graspbench report results/benchmark-1a2b3c4d\n"
                                    "  xdg-open \"$(graspbench report results/pilot)\"");
  const auto options = std::make_shared<ReportOptions>();
  command.add_option("folder", options->folder, "folder of the session or campaign")
      ->required()
      ->option_text("DIR");
  command.add_option("--out", options->out, "folder for a result that cannot be written")
      ->option_text("DIR")
      ->default_str("that of the result");
  AddReplaceOption(command, options->replace);
  AddAcceptDamageOption(command, options->on_damage);
  command.callback([options] { Report(*options); });
}

}  // namespace graspbench
