#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "workbench/commands/command.h"
#include "workbench/file_formats.h"

namespace graspbench {
namespace {

Json MakeFormatJson(const FileFormat& format) {
  Json keys = Json::array();
  for (const FileKey& key : format.keys) {
    keys.push_back({{"key", key.key},
                    {"unit", FindUnit(key.key)},
                    {"range", FormatRange(key)},
                    {"required", key.fallback == kRequired},
                    {"default", key.fallback == kRequired ? "" : key.fallback},
                    {"meaning", key.meaning}});
  }
  return {{"file", format.name}, {"about", format.about}, {"keys", keys}};
}

void PrintFormat(const std::string& name, bool json) {
  for (const FileFormat& format : ListFileFormats()) {
    if (format.name != name) continue;
    json ? PrintJson(MakeFormatJson(format))
         : PrintResult(format.name + ": " + format.about + "\n\n" + FormatFileKeys(format.keys));
  }
}

}  // namespace

void AddHelpCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "help", "Explain every key of a file: unit, range and default.",
                    "  graspbench help object.yaml\n"
                    "  graspbench help session.yaml --json");
  std::vector<std::string> names;
  for (const FileFormat& format : ListFileFormats()) names.push_back(format.name);
  const auto name = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  command.add_option("file", *name, ListNames(names))
      ->required()
      ->check(CLI::IsMember(names))
      ->option_text("FILE");
  command.add_flag("--json", *json, "print one JSON object");
  command.callback([name, json] { PrintFormat(*name, *json); });
}

}  // namespace graspbench
