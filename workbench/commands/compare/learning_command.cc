#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "datasets/analysis/controller_comparison.h"
#include "reports/kind_pages.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/result_page.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct LearningOptions {
  std::string folder, out;
  bool replace = false, json = false;
};

/** Digits as numbers: "2-9" before "2-10". */
bool IsBefore(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto take = [&](const std::string& text, size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const size_t start = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(start, at - start);
    };
    const std::string first = take(a, i), second = take(b, j);
    if (first.size() != second.size()) return first.size() < second.size();
    if (first != second) return first < second;
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> ListSessionFolders(const fs::path& folder) {
  std::error_code status;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    if (fs::exists(entry.path() / "session.json")) found.push_back(entry.path());
  }
  if (status) {
    throw Error(ErrorKind::kNotFound, folder.string() + ": " + status.message() +
                                          "; expected a folder with sessions in it");
  }
  if (found.size() < 2) {
    throw Error(ErrorKind::kUsage, folder.string() + ": " + std::to_string(found.size()) +
                                       " sessions directly in it; expected two or more");
  }
  std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
    return IsBefore(a.filename().string(), b.filename().string());
  });
  return found;
}

void ShowLearning(const LearningOptions& options) {
  std::vector<std::unique_ptr<Session>> sessions;
  std::vector<std::pair<std::string, const Session*>> named;
  for (const fs::path& folder : ListSessionFolders(options.folder)) {
    sessions.push_back(
        std::make_unique<Session>(LoadSession(folder, OnDamage::kRefuse, RecordParts::kBrief)));
    named.emplace_back(folder.filename().string(), sessions.back().get());
  }
  const std::vector<LearningPoint> points = ListLearningPoints(named);
  const auto columns = ListLearningColumns();
  if (!options.out.empty()) {
    StagedFolder staged({options.out,
                         "learning",
                         options.replace,
                         {options.folder},
                         "graspbench learning FOLDER --out DIR"});
    WriteFile(staged.path() / "learning.csv", FormatCsv(columns, points));
    WriteFile(staged.path() / "index.html", MakeLearningPage(points));
    staged.Commit();
  }
  if (options.json) return PrintJson({{"sessions", MakeJsonRows(columns, points)}});
  PrintResult(FormatTable(ShowTable(columns, points)) +
              "difference from the first session on the same draws; p: exact test clustered by "
              "hand and object\n");
  if (options.out.empty()) return;
  PrintResult(
      FormatPlaces(fs::path(options.out) / "index.html", fs::path(options.out) / "learning.csv"));
}

}  // namespace

void AddLearningCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "learning",
                    "Show the success rate over the sessions in a folder, as a learning curve.",
                    "  graspbench learning learned            sessions 0-0, 0-1, .. of a learning "
                    "run\n  graspbench learning policies --out curve");
  const auto options = std::make_shared<LearningOptions>();
  command.AddRequired("folder", options->folder, "folder of the sessions, ordered by name", "DIR");
  command.AddOption("--out", options->out, "folder for the table and a page with the curve", "DIR");
  AddReplaceOption(command, options->replace);
  AddJsonOption(command, options->json);
  command.SetAction([options] { ShowLearning(*options); });
}

}  // namespace graspbench
