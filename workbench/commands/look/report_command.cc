#include <filesystem>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "reports/page/paper.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/svg_to_pdf.h"
#include "workbench/result_page.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct ReportOptions {
  fs::path folder;
  fs::path out;    ///< empty: the result's own folder
  fs::path paper;  ///< empty: the page alone
  std::string figures = "shown";
  bool replace = false, json = false;
  PageViews views = PageViews::kAsBefore;
  OnDamage on_damage = OnDamage::kRefuse;
};

void WritePaper(const ReportOptions& options, const fs::path& page) {
  StagedFolder staged({options.paper, "paper", options.replace, {options.folder}});
  const bool has_pdf = HasPdfConverter();
  const PaperParts parts = options.figures == "all" ? PaperParts::kAll : PaperParts::kShown;
  for (const PaperFile& file : MakePaperFiles(ReadFile(page), parts)) {
    const fs::path path = staged.path() / file.name;
    MakeFolder(path.parent_path());
    WriteFile(path, file.content);
    if (has_pdf && path.extension() == ".svg") ConvertSvgToPdf(path);
  }
  staged.Commit();
  if (has_pdf) return;
  PrintMessage("figures are SVG only; install the Debian package librsvg2-bin for PDF");
}

void Report(const ReportOptions& options) {
  for (const fs::path& folder : {options.paper, options.out}) {
    if (!folder.empty()) CheckOutsideResults(folder);
  }
  if (!options.paper.empty()) {
    CheckOutputFolder({options.paper, "paper", options.replace, {options.folder}});
  }
  fs::path page;
  if (options.out.empty()) {
    page = options.folder /
           WriteResultPage(options.folder, options.folder, options.on_damage, options.views);
  } else {
    StagedFolder staged({options.out, "report", options.replace, {options.folder}});
    page = options.out /
           WriteResultPage(options.folder, staged.path(), options.on_damage, options.views);
    staged.Commit();
  }
  if (!options.json) PrintResult(page.string() + "\n");
  const Json paper = options.paper.empty() ? Json() : Json(options.paper.string());
  if (!paper.is_null()) WritePaper(options, page);
  if (options.json) {
    PrintJson({{"folder", options.folder.string()}, {"report", page.string()}, {"paper", paper}});
  } else if (!paper.is_null()) {
    PrintResult(options.paper.string() + "\n");
  }
}

}  // namespace

void AddReportCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "report", "Write the report of any result, finished or not.",
      "  graspbench report results/benchmark-1a2b3c4d\n  xdg-open \"$(graspbench report "
      "results/pilot --3d)\"\n  graspbench report results/pilot --paper paper   figures, tables, "
      "methods\n  graspbench compare results/a results/b          differences of two sessions");
  const auto options = std::make_shared<ReportOptions>();
  command.AddRequired("folder", options->folder,
                      "folder of a session, a campaign, a study or a basin", "DIR");
  command
      .AddOption("--out", options->out, "other folder, for example for a read-only result", "DIR")
      ->ShowDefault("that of the result");
  Option* paper = command.AddOption(
      "--paper", options->paper,
      "folder for figures, tables (CSV and LaTeX), methods.md and refs.bib", "DIR");
  command
      .AddOption(
          "--figures", options->figures,
          "with --paper: shown (unfolded on the page, at most 20 figures and 12 tables) or all",
          "WHICH")
      ->OneOf({"shown", "all"})
      ->Needs(paper)
      ->ShowDefault("shown");
  const auto add_views = [&](const char* name, PageViews views, const char* text) {
    return command.AddFlag(
        name, [options, views] { options->views = views; }, text);
  };
  Option* with = add_views("--3d", PageViews::kWith,
                           "for a session: add interactive 3-D scenes, one trial per outcome and "
                           "condition; an existing page keeps them");
  add_views("--no-3d", PageViews::kWithout, "remove the 3-D scenes from the page")->Excludes(with);
  AddReplaceOption(command, options->replace);
  AddJsonOption(command, options->json);
  AddAcceptDamageOption(command, options->on_damage);
  command.SetAction([options] { Report(*options); });
}

}  // namespace graspbench
