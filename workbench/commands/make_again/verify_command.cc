#include <memory>
#include <string>

#include "datasets/campaign/check_records.h"
#include "datasets/journal/sealed_store.h"
#include "workbench/command.h"

namespace graspbench {
namespace {

struct VerifyOptions {
  std::string folder;
  bool repair = false;
  bool json = false;
};

const char* NameState(const StoreState& state) {
  return state.damages.empty() ? "whole" : "damaged";
}

Json MakeVerifyJson(const VerifyOptions& options, const StoreRepair& repair) {
  Json damage = Json::array();
  for (const Damage& one : repair.state.damages) {
    damage.push_back({{"file", one.path},
                      {"line", one.line > 0 ? Json(one.line) : Json(nullptr)},
                      {"text", one.text}});
  }
  Json stale = Json::array();
  for (const StaleResult& one : repair.state.stale) {
    stale.push_back({{"path", one.path}, {"input", one.input}, {"command", one.command}});
  }
  return {{"folder", options.folder},
          {"kind", repair.state.kind},
          {"state", NameState(repair.state)},
          {"manifest_made_anew", repair.state.is_made_anew},
          {"repaired", repair.actions},
          {"damage", damage},
          {"unverified", FindUnverified(options.folder)},
          {"stale", stale}};
}

std::string FormatVerdict(const VerifyOptions& options, const StoreRepair& repair) {
  std::string text;
  for (const std::string& action : repair.actions) text += "repaired " + action + "\n";
  text += options.folder + ": the " + repair.state.kind + " is " + NameState(repair.state);
  if (repair.state.is_made_anew) {
    text += "; its manifest was rebuilt after a loss: earlier changes cannot be detected";
  }
  text += FormatDamage(repair.state.damages) + "\n";
  const std::string lost = DescribeLostFiles(options.folder, repair.state.damages);
  if (!lost.empty()) text += lost + "\n";
  for (const std::string& file : FindUnverified(options.folder)) {
    text += DescribeUnverified(file) + "\n";
  }
  for (const StaleResult& stale : repair.state.stale) {
    text += (stale.path == "." ? options.folder : stale.path) + " is stale: " + stale.input +
            " has changed since";
    if (!stale.command.empty()) text += "; to update: " + stale.command;
    text += "\n";
  }
  return text;
}

ExitCode Verify(const VerifyOptions& options) {
  StoreRepair repair =
      options.repair ? RepairStore(options.folder) : StoreRepair{{}, CheckStore(options.folder)};
  const Diagnostics findings = CheckRecords(options.folder, repair.state);
  if (!findings.entries().empty()) PrintMessage(findings.Format());
  if (options.json) {
    PrintJson(MakeVerifyJson(options, repair));
  } else {
    PrintResult(FormatVerdict(options, repair));
  }
  if (!repair.state.damages.empty()) return kExitBadInput;
  // A repair has done what it can; its results are for another command.
  return repair.state.stale.empty() || options.repair ? kExitOk : kExitFailed;
}

}  // namespace

void AddVerifyCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "verify", "Compare a result folder with the hashes in its manifest.",
      "  graspbench verify results/pilot             damaged: exit code 3; else stale: exit code "
      "1\n"
      "  graspbench verify results/pilot --repair    sets damaged lines aside, seals the rest");
  const auto options = std::make_shared<VerifyOptions>();
  command.AddRequired("folder", options->folder, "folder of any result", "DIR");
  command.AddFlag("--repair", options->repair,
                  "move damaged lines into files beside their journals; no data are deleted");
  AddJsonOption(command, options->json, "print the verdict as one JSON object");
  command.SetAction([options] { return Verify(*options); });
}

}  // namespace graspbench
