#include <map>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "core/trial/outcome.h"
#include "datasets/plan/session_config.h"
#include "workbench/manual/maker/manual_site.h"
#include "workbench/terminal/command_line.h"
#include "workbench/text/file_formats.h"
#include "workbench/text/help_text.h"

namespace graspbench {
namespace {

/** Text of a cell: no bar ends it, no sign of Markdown is taken for one. */
std::string EscapeCell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\|*_<>[]`&~").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string MakeRow(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + cell + " |";
  return row + "\n";
}

std::string MakeHead(const std::vector<std::string>& heads) {
  return MakeRow(heads) + MakeRow(std::vector<std::string>(heads.size(), "---"));
}

std::string MakeCode(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

/** The options and arguments of a command, and of those below it. */
void AddCommands(const Command& command, const std::string& above, std::string& page) {
  for (const auto& each : command.subcommands()) {
    const std::string path = above + " " + each->name();
    page += "\n## " + path + "\n\n" + EscapeCell(each->description()) + "\n\n```text\n" +
            each->examples() + "\n```\n\n";
    std::string rows;
    for (const auto& option : each->options()) {
      if (option->name() == "--help") continue;
      rows += MakeRow({MakeCode(option->name()), EscapeCell(option->description()),
                       EscapeCell(option->value_name()),
                       option->is_required() ? "required" : EscapeCell(option->shown_default())});
    }
    if (!rows.empty()) page += MakeHead({"option", "meaning", "value", "default"}) + rows;
    AddCommands(*each, path, page);
  }
}

std::string MakeOptionPage(const Command& program) {
  std::string page =
      "# Options\n\nEvery command with its options and arguments, as `graspbench COMMAND --help` "
      "prints them.\n";
  AddCommands(program, program.name(), page);
  return page;
}

/** The file whose row says the same of a key; empty: none before `format` does. */
std::string FindEarlier(const FileFormat& format, const FileKey& key) {
  for (const FileFormat& earlier : ListFileFormats()) {
    if (&earlier == &format) break;
    const FileKey* row = FindFileKey(earlier.keys, key.key);
    if (row && row->fallback == key.fallback && row->meaning == key.meaning &&
        FormatRange(*row) == FormatRange(key)) {
      return earlier.name;
    }
  }
  return "";
}

std::string MakeKeyPage() {
  std::string page =
      "# Keys\n\nEvery key of every file with unit, range, default and meaning, as `graspbench "
      "help FILE` prints them; `graspbench new` writes a commented example, `graspbench help FILE "
      "--schema` a JSON Schema for editors and validators.\n";
  for (const FileFormat& format : ListFileFormats()) {
    std::string rows;
    std::map<std::string, std::string> shared;  // by file
    for (const FileKey& key : format.keys) {
      const std::string earlier = FindEarlier(format, key);
      if (!earlier.empty()) {
        std::string& list = shared[earlier];
        list += (list.empty() ? "" : ", ") + MakeCode(key.key);
        continue;
      }
      rows += MakeRow({MakeCode(key.key), EscapeCell(key.meaning), EscapeCell(FindUnit(key.key)),
                       FormatRange(key),
                       key.fallback == kRequired ? "required" : EscapeCell(key.fallback)});
    }
    page += "\n## " + format.name + "\n\n" + Capitalise(EscapeCell(format.about)) + ".\n\n";
    if (!rows.empty()) page += MakeHead({"key", "meaning", "unit", "range", "default"}) + rows;
    for (const auto& [file, keys] : shared) page += "\nAs in " + file + ": " + keys + ".\n";
  }
  return page;
}

std::string MakeColumnPage() {
  std::string page =
      "# Columns\n\nEvery column of every table that the program writes, as `graspbench help FILE` "
      "prints them. An empty cell is a missing value, a boolean is 0 or 1. Words in capitals are "
      "placeholders for names in the data: DIGIT, JOINT, FACTOR, GROUP, LEVEL.\n";
  for (const TableFormat& table : ListTableFormats()) {
    const size_t end = table.about.find(": ");  // of where the table is written
    page += "\n## " + table.name + " (" + table.about.substr(0, end) + ")\n\n";
    if (end != table.about.npos)
      page += Capitalise(EscapeCell(table.about.substr(end + 2))) + ".\n\n";
    page += MakeHead({"column", "meaning", "type", "unit"});
    for (const TableColumn& column : table.columns) {
      page += MakeRow({MakeCode(column.name), EscapeCell(column.meaning), column.type,
                       EscapeCell(column.unit)});
    }
  }
  return page;
}

std::string MakeOutcomePage() {
  std::string page =
      "# Outcomes, exit codes, presets\n\nThe possible outcomes of a trial, the exit codes of "
      "commands, and the named groups of settings.\n\n## Outcomes of a trial\n\n" +
      MakeHead({"outcome", "code", "meaning"});
  for (const OutcomeRow& row : kOutcomes) {
    if (row.value == Outcome::kNotRun) continue;
    const GlossaryEntry* entry = FindGlossaryEntry(row.name);
    page += MakeRow({row.name, MakeCode(row.code), entry ? EscapeCell(entry->meaning) : ""});
  }
  page += "\n## Exit codes\n\n" + MakeHead({"code", "meaning"});
  const std::vector<std::pair<int, const char*>> codes = {
      {kExitOk, "done"},
      {kExitFailed, "failed, or a verified result is out of date"},
      {kExitUsage, "the command line is wrong, or a folder is not writable"},
      {kExitBadInput, "an input file is wrong, or a result is damaged"},
      {kExitNumericalFailures, "some trials failed numerically; everything is written"},
      {kExitEnvironment, "the machine lacks something: disk space, memory, a program"},
      {kExitInterrupted, "interrupted; repeat the command with `--resume` to continue"}};
  for (const auto& [code, meaning] : codes) page += MakeRow({std::to_string(code), meaning});
  page += "\n## Presets\n\n" + MakeHead({"preset", "settings"});
  for (const Preset& preset : ListPresets()) {
    page += MakeRow({MakeCode(preset.name), EscapeCell(preset.about)});
  }
  return page;
}

}  // namespace

std::string MakeReference(const std::string& page, const Command& program) {
  if (page == "options") return MakeOptionPage(program);
  if (page == "keys") return MakeKeyPage();
  if (page == "columns") return MakeColumnPage();
  return MakeOutcomePage();
}

}  // namespace graspbench
