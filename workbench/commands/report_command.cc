#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "datasets/campaign/campaign_store.h"
#include "datasets/session/session_store.h"
#include "reports/campaign/campaign_report.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace {

struct ReportOptions {
  std::string folder;
  OnDamage on_damage = OnDamage::kRefuse;
};

std::string WriteReport(const ReportOptions& options) {
  const auto tell = [](const std::vector<Damage>& damage) {
    if (!damage.empty()) PrintMessage("damage accepted" + FormatDamage(damage));
  };
  if (HasCampaign(options.folder)) {
    const Campaign campaign = LoadCampaign(options.folder, options.on_damage);
    tell(campaign.damage);
    return WriteCampaignReport(options.folder, campaign).string();
  }
  const Session session = LoadSession(options.folder, options.on_damage);
  tell(session.damage);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  return WriteSessionReport(options.folder, session).string();
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
  AddAcceptDamageOption(command, options->on_damage);
  command.callback([options] { PrintResult(WriteReport(*options) + "\n"); });
}

}  // namespace graspbench
