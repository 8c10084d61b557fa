#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "datasets/plan/session_config.h"
#include "workbench/command.h"
#include "workbench/tables/grasp_tables.h"
#include "workbench/text/help_text.h"

namespace graspbench {
namespace {

constexpr char kGraspTypesTopic[] = "grasp-types";

/** Of a file that people write, or of the tables of this name. False: there is none. */
bool PrintFormat(const std::string& name, bool json, bool schema) {
  for (const FileFormat& format : ListFileFormats()) {
    if (format.name != name) continue;
    schema ? PrintJson(MakeFileSchema(format))
    : json ? PrintJson(MakeFormatJson(format))
           : PrintResult(format.name + ": " + format.about + "\n\n" + FormatFileKeys(format.keys));
    return true;
  }
  std::string text;
  Json tables = Json::array();
  for (const TableFormat& table : ListTableFormats()) {
    if (table.name != name) continue;
    tables.push_back(MakeTableJson(table));
    text += (text.empty() ? "" : "\n") + table.name + ": " + table.about + "\n\n" +
            FormatTableColumns(table);
  }
  if (text.empty()) return false;
  json ? PrintJson({{"tables", tables}}) : PrintResult(text);
  return true;
}

/** What "graspbench --help" prints, and what else has a name: presets and files. */
std::string FormatOverview(const Command& program, const std::vector<std::string>& files) {
  std::string presets;
  for (const Preset& preset : ListPresets()) {
    presets += fmt::format("  {:<27} {}\n", preset.name, preset.about);
  }
  return program.FormatHelp("") +
         "\nPresets (graspbench run --preset NAME, or preset: NAME in a session file):\n" +
         presets + "\nFiles (graspbench help FILE):\n  " + ListNames(files) +
         "\n\nGrasp types in other taxonomies: graspbench help grasp-types\nA setting, for "
         "example: graspbench help model.friction_scale\nA measure, a table or a column, for "
         "example: graspbench help gft\nAn outcome or a flag, for example: graspbench help 'pushed "
         "away'\n";
}

/** The meanings of an option, named without its dashes, in all commands that have it. */
std::string ExplainOption(const Command& command, const std::string& above,
                          const std::string& name) {
  std::string text;
  for (const auto& each : command.subcommands()) {
    const std::string path = above + " " + each->name();
    for (const auto& option : each->options()) {
      if (option->is_argument() || option->name() != "--" + name) continue;
      text += path + " --" + name + "\n  " + option->description() + "\n";
    }
    text += ExplainOption(*each, path, name);
  }
  return text;
}

/** What "graspbench WORDS --help" prints, and what a word means as a measure, a column or a setting.
@throws Error(kUsage) when it is none of these. */
std::string FindCommandHelp(const Command& program, const std::vector<std::string>& words) {
  const Command* command = &program;
  std::string above;
  for (const std::string& word : words) {
    std::vector<std::string> names;
    const Command* next = nullptr;
    for (const auto& each : command->subcommands()) {
      names.push_back(each->name());
      if (each->name() == word) next = each.get();
    }
    if (!next && command == &program) {
      const std::string meanings = ExplainWord(fmt::format("{}", fmt::join(words, " "))) +
                                   ExplainOption(program, program.name(), word);
      if (!meanings.empty()) return meanings;
      for (const FileFormat& format : ListFileFormats()) names.push_back(format.name);
      names.push_back(kGraspTypesTopic);
    }
    if (!next) {
      throw Error(ErrorKind::kUsage, "\"" + word + "\" is not a command, file, setting or term" +
                                         (command == &program ? SuggestWords(word, names)
                                                              : SuggestNames(word, names)));
    }
    above += (above.empty() ? "" : " ") + command->name();
    command = next;
  }
  const std::string setting = words.size() == 1 ? ExplainFileKey(words.front()) : "";
  return command->FormatHelp(above) + (setting.empty() ? "" : "\n" + setting);
}

/** For completion. */
std::vector<std::string> ListTopics(const std::vector<std::string>& files, const Command& program) {
  std::vector<std::string> names = {kGraspTypesTopic};
  names.insert(names.end(), files.begin(), files.end());
  for (const auto& command : program.subcommands()) names.push_back(command->name());
  return names;
}

}  // namespace

void AddHelpCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "help",
      "Explain a command, setting, column, outcome, flag or term, or every key of a file.",
      "  graspbench help                       commands, presets and files\n"
      "  graspbench help object.yaml\n"
      "  graspbench help session.yaml --json\n"
      "  graspbench help study.yaml --schema   for an editor or validator\n"
      "  graspbench help model.friction_scale  a setting\n"
      "  graspbench help gft                   a measure or a column of a table\n"
      "  graspbench help measures.csv          the columns of a table\n"
      "  graspbench help hand develop          as graspbench hand develop --help");
  std::vector<std::string> files;
  for (const FileFormat& format : ListFileFormats()) {
    if (!format.is_frozen) files.push_back(format.name);
  }
  const auto words = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false), schema = std::make_shared<bool>(false);
  command
      .AddOption("topic", *words,
                 "a command, grasp-types, a measure, a setting, a table, or one of " +
                     ListNames(files) + "; absent: all there is",
                 "COMMAND|FILE|KEY|WORD")
      ->Suggest(ListTopics(files, program));
  command.AddFlag("--json", *json, "of a file: print one JSON object");
  command.AddFlag("--schema", *schema, "of a file: print its JSON Schema")->Excludes("--json");
  command.SetAction([&program, files, words, json, schema] {
    const bool is_file = !words->empty() && std::count(files.begin(), files.end(), words->front());
    if (*schema && !is_file)
      throw Error(ErrorKind::kUsage, "--schema is of a file: " + ListNames(files));
    if (words->empty()) return PrintResult(FormatOverview(program, files));
    if (words->front() == kGraspTypesTopic)
      return *json ? PrintJson(MakeGraspTypesJson()) : PrintResult(FormatGraspTypes());
    if (words->size() == 1 && PrintFormat(words->front(), *json, *schema)) return;
    PrintResult(FindCommandHelp(program, *words));
  });
}

}  // namespace graspbench
