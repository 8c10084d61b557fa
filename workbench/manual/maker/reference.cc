#include "workbench/manual/maker/reference.h"

#include <vector>

#include "core/trial/outcome.h"
#include "datasets/plan/presets.h"
#include "datasets/records/trial_table.h"
#include "human_study/study/output/statistics_table.h"
#include "workbench/terminal/command_line.h"
#include "workbench/text/file_formats.h"

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

void AddCommands(const Command& command, const std::string& above, std::string& page) {
  for (const auto& each : command.subcommands()) {
    page +=
        "\n## " + above + " " + each->name() + "\n\n```text\n" + each->FormatHelp(above) + "```\n";
    AddCommands(*each, above + " " + each->name(), page);
  }
}

template <class Row>
std::string MakeColumnTable(const std::string& title, const std::string& about,
                            const std::vector<CsvColumn<Row>>& columns) {
  std::string text =
      "\n## " + title + "\n\n" + about + "\n\n" + MakeHead({"column", "type", "unit", "meaning"});
  for (const CsvColumn<Row>& column : columns) {
    text += MakeRow(
        {MakeCode(column.name), column.type, EscapeCell(column.unit), EscapeCell(column.meaning)});
  }
  return text;
}

}  // namespace

std::string MakeCommandReference(const Command& program) {
  std::string page =
      "# Commands\n\nEvery command and option, as `graspbench COMMAND --help` prints them.\n";
  AddCommands(program, program.name(), page);
  return page;
}

std::string MakeFileReference() {
  std::string page =
      "# Files that you write\n\nEvery key with unit, range, default and meaning, as `graspbench "
      "help FILE` prints them; `graspbench new` writes a commented example, `graspbench help FILE "
      "--schema` a JSON "
      "Schema for editors and validators.\n";
  for (const FileFormat& format : ListFileFormats()) {
    page += "\n## " + format.name + "\n\n" + EscapeCell(format.about) + ".\n\n" +
            MakeHead({"key", "unit", "range", "default", "meaning"});
    for (const FileKey& key : format.keys) {
      page += MakeRow({MakeCode(key.key), EscapeCell(FindUnit(key.key)), FormatRange(key),
                       key.fallback == kRequired ? "required" : EscapeCell(key.fallback),
                       EscapeCell(key.meaning)});
    }
  }
  return page;
}

std::string MakeColumnReference() {
  return "# Columns of tables\n\nEvery table has a data dictionary beside it; an empty cell is a "
         "missing value, a boolean is 0 or 1.\n" +
         MakeColumnTable("trials.csv",
                         "`export/trials.csv` of a session, one row per trial; sweeps add their "
                         "factors.",
                         ListTrialColumns({})) +
         MakeColumnTable("events.csv", "`export/events.csv`, one row per contact event.",
                         ListEventColumns()) +
         MakeColumnTable("statistics.csv",
                         "`statistics.csv` of a study of people, one row per test.",
                         ListStatisticColumns());
}

std::string MakeOutcomeReference() {
  std::string page =
      "# Outcomes, exit codes, presets\n\nHow a trial may end, what a command's exit code says, "
      "and "
      "which settings have a name.\n\n## Outcomes of a trial\n\n" +
      MakeHead({"outcome", "code"});
  for (const OutcomeRow& row : kOutcomes) {
    if (row.value != Outcome::kNotRun) page += MakeRow({row.name, MakeCode(row.code)});
  }
  page += "\n## Exit codes\n\n" + MakeHead({"code", "meaning"});
  const std::vector<std::pair<int, const char*>> codes = {
      {kExitOk, "done"},
      {kExitFailed, "failed, or what was verified is out of date"},
      {kExitUsage, "the command line is wrong, or a folder may not be written"},
      {kExitBadInput, "an input file is wrong, or a result is damaged"},
      {kExitNumericalFailures, "some trials failed numerically; everything is written"},
      {kExitEnvironment, "the machine cannot: disk, memory, a missing program"},
      {kExitInterrupted, "interrupted; the same command with `--resume` goes on"}};
  for (const auto& [code, meaning] : codes) page += MakeRow({std::to_string(code), meaning});
  page += "\n## Presets\n\n" + MakeHead({"preset", "settings"});
  for (const Preset& preset : ListPresets()) {
    page += MakeRow({MakeCode(preset.name), EscapeCell(preset.about)});
  }
  return page;
}

}  // namespace graspbench
