#include <CLI/CLI.hpp>
#include <memory>

#include "datasets/campaign/campaign_store.h"
#include "datasets/session/session_store.h"
#include "reports/campaign/campaign_report.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"

namespace graspbench {

void AddReportCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(program, "report",
                                    "Write the report of a session or a campaign, finished or not.",
                                    "  graspbench report results/benchmark-1a2b3c4d\n"
                                    "  xdg-open \"$(graspbench report results/pilot)\"");
  const auto folder = std::make_shared<std::string>();
  command.add_option("folder", *folder, "folder of the session or campaign")
      ->required()
      ->option_text("DIR");
  command.callback([folder] {
    if (HasCampaign(*folder)) {
      PrintResult(WriteCampaignReport(*folder, LoadCampaign(*folder)).string() + "\n");
      return;
    }
    const Session session = LoadSession(*folder);
    if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
    PrintResult(WriteSessionReport(*folder, session).string() + "\n");
  });
}

}  // namespace graspbench
