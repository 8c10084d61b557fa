#include <filesystem>
#include <memory>

#include "core/base/files/files.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/recording.h"
#include "human_study/recording/save_recording.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/mocap_plot.h"

namespace graspbench {
namespace {

struct MocapOptions {
  std::string in, out;
  ImportOptions import;
  bool json = false;
};

using SharedOptions = std::shared_ptr<MocapOptions>;

/** The original must survive: it may be the only copy. So must whatever else is there. */
void CheckOutput(const MocapOptions& options) {
  std::error_code status;
  if (std::filesystem::equivalent(options.in, options.out, status)) {
    throw Error(ErrorKind::kUsage,
                "\"" + options.out + "\" is the recording itself; name another file to write");
  }
  CheckOutputFile(options.out);
}

void PrintFindings(const Recording& recording) {
  for (const ImportFinding& finding : recording.findings) {
    PrintMessage(finding.code + " at " + finding.where + ": " + finding.text);
  }
}

void AddImportOptions(Command& command, const SharedOptions& options) {
  command.AddRequired("file", options->in, "recording", "FILE");
  std::string formats;
  for (const Importer& importer : ImporterList()) {
    formats += (formats.empty() ? "" : ", ") + std::string(importer.id);
  }
  command.AddOption("--format", options->import.format,
                    "importer, overriding detection by content and name: " + formats);
  command.AddOption("--unit", options->import.unit,
                    "length unit of a file that states none: mm, cm, m, in");
  command.AddOption("--mapping", options->import.mapping,
                    "YAML file that names the columns of a plain table", "FILE");
  command.AddOption("--trial", options->import.trial,
                    "trial to read from a plain table with several trials");
  command.AddFlag("--accept-truncated", options->import.accept_truncated,
                  "read the intact part of a truncated file");
  command.AddFlag("--trust-residuals", options->import.trust_residuals,
                  "C3D: accept residuals that mark every sample as invalid");
}

void ShowRecording(const MocapOptions& options) {
  const Recording recording = LoadRecording(options.in, options.import);
  if (options.json) {
    PrintJson(DescribeRecording(recording));
  } else {
    PrintResult(FormatRecording(recording));
  }
}

void ConvertRecording(const MocapOptions& options) {
  CheckOutput(options);
  const Recording recording = LoadRecording(options.in, options.import);
  PrintFindings(recording);
  const size_t num_left_out = SaveRecording(options.out, recording);
  if (num_left_out > 0) {
    PrintMessage(std::to_string(num_left_out) + " points are not positions and were left out");
  }
  PrintResult(options.out + "\n");
}

void PlotRecording(const MocapOptions& options) {
  CheckOutput(options);
  const Recording recording = LoadRecording(options.in, options.import);
  PrintFindings(recording);
  const std::string name = std::filesystem::path(options.in).filename().string();
  WriteFileAtomically(options.out, MakeRecordingPage(name, recording));
  PrintResult(options.out + "\n");
}

void RedactFile(const MocapOptions& options) {
  CheckOutput(options);
  const std::vector<PersonalField> fields = RedactRecording(options.in, options.out);
  for (const PersonalField& field : fields) {
    PrintMessage("blanked " + field.where + ": " + field.text);
  }
  if (fields.empty())
    PrintMessage("no personal data found in the fields that this format provides for it");
  PrintResult(options.out + "\n");
}

}  // namespace

void AddMocapCommand(Command& program) {
  Command& group = AddSubcommand(program, "mocap", "Show, draw, convert and redact motion capture.",
                                 "  graspbench mocap info reach01.c3d\n"
                                 "  graspbench mocap convert reach01.tsv reach01.c3d");
  group.RequireSubcommand();
  const auto options = std::make_shared<MocapOptions>();

  Command& info =
      AddSubcommand(group, "info", "Show the contents of a recording and every assumption.",
                    "  graspbench mocap info reach01.c3d\n"
                    "  graspbench mocap info table.txt --mapping columns.yaml --json");
  AddImportOptions(info, options);
  AddJsonOption(info, options->json, "print one JSON object, with the mean of every point");
  info.SetAction([options] { ShowRecording(*options); });

  Command& convert = AddSubcommand(group, "convert",
                                   "Write a recording as .c3d, .tsv (Qualisys) or .csv (metres).",
                                   "  graspbench mocap convert reach01.n3d reach01.c3d\n"
                                   "  graspbench mocap convert take.csv take.c3d --unit mm");
  AddImportOptions(convert, options);
  convert.AddRequired("out", options->out, "file to write", "OUT");
  convert.SetAction([options] { ConvertRecording(*options); });

  Command& plot =
      AddSubcommand(group, "plot", "Draw gaps, height and speed of every point into one HTML page.",
                    "  graspbench mocap plot reach01.c3d reach01.html");
  AddImportOptions(plot, options);
  plot.AddRequired("out", options->out, "HTML file to write", "OUT");
  plot.SetAction([options] { PlotRecording(*options); });

  Command& redact = AddSubcommand(
      group, "redact", "Copy a recording with names, dates and paths blanked; data stay.",
      "  graspbench mocap redact reach01.c3d share/reach01.c3d");
  redact.AddRequired("file", options->in, "recording", "FILE");
  redact.AddRequired("out", options->out, "file to write", "OUT");
  redact.SetAction([options] { RedactFile(*options); });
}

}  // namespace graspbench
