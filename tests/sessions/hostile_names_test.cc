/** @file
Hostile text in every name that a user can choose, and every output looked at: the terminal shows
it, pages and figures hold no element that a page of harmless names lacks, cells of tables are no
formulas, YAML and JSON can be read, scripts run nothing of it. A name may be refused, in words; how
much must be accepted stands with each text. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "core/base/text/text.h"
#include "tests/sessions/test_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct HostileText {
  const char* id;
  std::string name;  ///< of files and folders, too: one line without a slash
  int num_accepted;  ///< commands that end with 0 or 1 at least
};
void PrintTo(const HostileText& text, std::ostream* out) { *out << text.id; }

const HostileText kTexts[] = {
    {"markup", "=1+<img src=x onerror=alert(1)>&amp;#: {%}[*]!|\\", 30},
    {"shell", "@$(touch pwned)`touch pwned`;touch pwned&touch pwned|touch pwned", 30},
    {"quotes", "+'\"><b onmouseover='alert(1)' x=\"", 10},
    {"control", "\x1b[31m\x1b]0;title\x07\u202e\u2066\u2028\u0085", 6}};

/** As much as a value between quotes may hold. */
std::string MakeValue(const std::string& name) {
  return name + "</script><script>alert(1)</script>--><svg onload=alert(1)>,\"e";
}

std::string Replace(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string QuoteForShell(const std::string& text) {
  return "'" + Replace(text, "'", "'\\''") + "'";
}

/** A JSON string is one of YAML, too. */
std::string QuoteForYaml(const std::string& text) { return FormatJson(text); }

/** Elements with their attributes, as a browser finds them: "img", "img onerror". Scripts and
styles are texts to it, up to their end. */
std::map<std::string, int> CountMarkup(const std::string& page) {
  std::map<std::string, int> found;
  const auto is_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == ':' || c == '_';
  };
  for (size_t at = page.find('<'); at != page.npos; at = page.find('<', at)) {
    if (page.compare(at, 4, "<!--") == 0) {
      at = std::min(page.find("-->", at), page.size());
      continue;
    }
    size_t end = ++at;
    while (end < page.size() && is_name(page[end])) ++end;
    const std::string element = page.substr(at, end - at);
    if (element.empty()) continue;
    ++found[element];
    while (end < page.size() && page[end] != '>') {
      if (page[end] == '"' || page[end] == '\'') {
        end = std::min(page.find(page[end], end + 1), page.size() - 1) + 1;
      } else if (is_name(page[end])) {
        const size_t start = end;
        while (end < page.size() && is_name(page[end])) ++end;
        ++found[element + " " + page.substr(start, end - start)];
        while (end < page.size() && page[end] == '=' && page[end + 1] != '"' &&
               page[end + 1] != '\'') {
          while (end < page.size() && page[end] != ' ' && page[end] != '>') ++end;
        }
      } else {
        ++end;
      }
    }
    at = end;
    if (element == "script" || element == "style")
      at = std::min(page.find("</" + element, at), page.size());
  }
  return found;
}

/** Rows of cells after RFC 4180. */
std::vector<std::vector<std::string>> ReadCells(const std::string& text) {
  std::vector<std::vector<std::string>> rows = {{""}};
  bool is_quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& cell = rows.back().back();
    if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += text[++i];
    } else if (c == '"' && (is_quoted || cell.empty())) {
      is_quoted = !is_quoted;
    } else if (is_quoted) {
      cell += c;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else if (c == '\n') {
      rows.push_back({""});
    } else {
      cell += c;
    }
  }
  rows.pop_back();
  return rows;
}

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

class GRASPBENCH_SUITE : public testing::TestWithParam<HostileText> {
 protected:
  void Write(const fs::path& file, const std::string& content) const {
    MakeFolder(file.parent_path());
    WriteFile(file, content);
  }
  /** Copies, with texts replaced. */
  void Copy(const fs::path& from, const fs::path& to,
            const std::vector<std::pair<std::string, std::string>>& replaced) const {
    std::string text = ReadFile(from);
    for (const auto& [old, now] : replaced) {
      EXPECT_NE(text.find(old), text.npos) << from << ": " << old;
      text = Replace(text, old, now);
    }
    Write(to, text);
  }

  /** All commands with one name; what they print and leave is harmless. */
  void RunAll(const fs::path& folder, const std::string& name);
  void Run(const std::string& line);
  void CheckFiles(const fs::path& folder);

  const TestFolder own_{std::string("hostile_names_") + GetParam().id};
  const fs::path& top_ = own_.path();
  fs::path folder_;
  std::string name_;
  int num_accepted_ = 0;
  bool is_reference_ = true;
  std::map<std::string, int> markup_;  // of all harmless pages
};

/** NAME stands for the name in quotes of the shell, GB for the program. */
void GRASPBENCH_SUITE::Run(const std::string& line) {
  const fs::path output = top_ / "output";
  const std::string text = Replace(
      Replace(Replace(line, "TRIAL",
                      "\"$(sed -n 2p results/NAME/export/trials.csv 2>/dev/null | cut -d, -f1)\""),
              "NAME", QuoteForShell(name_)),
      "GB", "'" GRASPBENCH_PROGRAM "'");
  Write(top_ / "commands", "cd " + QuoteForShell(folder_) + "\n" + text + "\n");
  const int status =
      std::system(("HOME=" + QuoteForShell(top_) + " bash " + QuoteForShell(top_ / "commands") +
                   " >" + QuoteForShell(output) + " 2>&1 </dev/null")
                      .c_str());
  ASSERT_TRUE(WIFEXITED(status)) << line;
  const std::string printed = ReadFile(output);
  EXPECT_LE(WEXITSTATUS(status), 5) << line << "\n" << printed;
  EXPECT_EQ(EscapeForTerminal(printed), printed) << line;
  if (is_reference_) {
    EXPECT_LE(WEXITSTATUS(status), 1) << line << "\n" << printed;
  }
  num_accepted_ += WEXITSTATUS(status) <= 1;
}

void GRASPBENCH_SUITE::RunAll(const fs::path& folder, const std::string& name) {
  const fs::path root = FindDataRoot(), tum = root / "core/hand/models/tum",
                 ball = root / "objects/catalogue/golf_ball";
  const std::string value = MakeValue(name);
  folder_ = folder;
  name_ = name;
  num_accepted_ = 0;
  MakeFolder(folder);

  const fs::path hand = folder / "hands" / name, object = folder / "objects" / name;
  fs::create_directories(folder / "hands");
  fs::copy(tum, hand, fs::copy_options::recursive);
  Copy(tum / "hand.yaml", hand / "hand.yaml",
       {{"TUM Hand", QuoteForYaml(value)}, {"name: index", "name: " + QuoteForYaml(value)}});
  Write(object / "mesh.obj", ReadFile(ball / "mesh.obj"));
  Copy(ball / "object.yaml", object / "object.yaml", {{"golf ball", QuoteForYaml(value)}});
  Write(folder / "s.yaml", "hands: [tum]\nobjects: [" +
                               QuoteForYaml((folder / "objects" / name).string()) +
                               "]\ntrials: 1\n");
  Write(folder / "t.yaml", "hands: [tum]\nobjects: [golf_ball]\ntrials: 1\n");
  Run("GB hand check hands/NAME");
  Run("GB hand show hands/NAME");
  Run("GB object show objects/NAME");
  Run("GB run --hand hands/NAME --object golf_ball --trials 1 --jobs 1 --out h");
  Run("GB run s.yaml --jobs 1 --out results/NAME || GB run t.yaml --out results/NAME");
  for (const char* line :
       {"judge results/NAME --jobs 1", "report results/NAME --3d",
        "report results/NAME --paper paper", "export results/NAME --records",
        "export results/NAME --mjcf all --out mjcf-NAME", "status results/NAME",
        "verify results/NAME", "trial results/NAME TRIAL --page NAME.html --trace NAME.csv",
        "trial results/NAME TRIAL --trace NAME.svg", "trial results/NAME TRIAL --json",
        "replay results/NAME --all --trajectory csv --out moved-NAME", "report h",
        "status h --json", "render tum objects/NAME g1 --out NAME.png"}) {
    Run(std::string("GB ") + line);
  }
  Run("cp -r results/NAME copied-NAME && GB compare results/NAME copied-NAME");
  Run("GB run s.yaml --plan-only --out split-NAME && GB submit split-NAME --engine local --array "
      "1");
  Run("GB optimise --hand tum --object objects/NAME --evaluations 2 --fitness-trials 1 --out "
      "optimised-NAME");
  Run("GB basin --hand tum --object objects/NAME --samples 2 --out basin-NAME");
  Run("GB new object made-NAME");
  Write(folder / "typed", "hand tum\nobject " + QuoteForShell("objects/" + name) +
                              "\nrun\nwhy\nreport " + QuoteForShell("shell-" + name + ".html") +
                              "\nsave " + QuoteForShell("saved-" + name + ".yaml") + "\n");
  Run("GB shell --log log-NAME < typed");

  Copy(root / "tests/fuzz/cases/hand_import/good.urdf", folder / "foreign" / (name + ".urdf"),
       {{"<robot name=\"",
         "<robot name=\"" +
             Replace(Replace(Replace(value, "&", "&amp;"), "<", "&lt;"), "\"", "&quot;")}});
  Run("GB hand import foreign/NAME.urdf --out imported-NAME");

  Write(folder / "p.yaml", "about: " + QuoteForYaml(value) +
                               "\nstages:\n  first:\n    command: run\n    inputs: {session: "
                               "t.yaml}\n    parameters: {seed: 7}\n");
  Write(folder / "q.yaml", "about: x\nstages:\n  " + QuoteForYaml(name) +
                               ":\n    command: run\n    inputs: {session: t.yaml}\n");
  for (const char* line :
       {"graph p.yaml", "run p.yaml", "pack p.yaml NAME.tar", "export p.yaml --as snakemake",
        "graph q.yaml", "export q.yaml --as dvc"}) {
    Run(std::string("GB pipeline ") + line);
  }

  Write(folder / "foreign" / (name + ".yaml"),
        "format: isaac_grasp\nformat_version: 1.0\nobject_frame: toy_cube\ngripper_frame: " +
            QuoteForYaml(value) + "\ngrasps:\n  " + QuoteForYaml(value) +
            ":\n    confidence: 1.0\n    position: [0, 0, -0.07]\n"
            "    orientation: {w: 1, xyz: [0, 0, 0]}\n"
            "    cspace_position: {thumb_joint: 0.6, index_joint: 0.6}\n");
  Copy(root / "datasets/profiles/own.yaml", folder / "foreign" / ("profile-" + name + ".yaml"),
       {{"about: ", "about: " + QuoteForYaml(value) + "  # "}});
  Run("GB new hand gripper");
  const std::string grasps =
      " foreign/NAME.yaml --hand-frame palm --object-frame mesh --open "
      "thumb_joint=0.1,index_joint=0.1 ";
  Run("GB grasps info" + grasps);
  Run("GB grasps judge" + grasps +
      "--hand gripper --profile foreign/profile-NAME.yaml --jobs 1 --out judged-NAME");
  Run("GB report judged-NAME");
  Run("GB grasps convert" + grasps + "--to isaac --out converted-NAME.yaml");

  const std::string label = Replace(name, "\t", " ");
  Write(folder / (name + ".tsv"),
        "NO_OF_FRAMES\t3\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nDATA_INCLUDED\t3D\nMARKER_NAMES\t" +
            label + "\tindex\n1\t2\t3\t4\t5\t6\n1\t2\t3\t4\t5\t7\n1\t2\t3\t4\t5\t7\n");
  for (const char* line : {"info NAME.tsv", "info NAME.tsv --json", "plot NAME.tsv marker-NAME.svg",
                           "convert NAME.tsv marker-NAME.csv"})
    Run(std::string("GB mocap ") + line);
  const std::string cell = "\"" + Replace(value, "\"", "\"\"") + "\"";
  Write(folder / "study.yaml", "name: " + QuoteForYaml(value) + "\nmarkers: {thumb: [" +
                                   QuoteForYaml(label) + "], index: [index]}\nfactors: [size]\n");
  Write(folder / "trials.csv", "participant,file,size\n" + cell + ",\"" +
                                   Replace(name, "\"", "\"\"") + ".tsv\"," + cell + "\n");
  Run("GB study run study.yaml --out study-NAME");
}

void GRASPBENCH_SUITE::CheckFiles(const fs::path& folder) {
  const std::set<std::string> given = {"hands", "objects", "foreign", "inputs"};
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::path& path = entry->path();
    if (entry->is_directory() && given.count(path.filename().string()) > 0)
      entry.disable_recursion_pending();
    EXPECT_EQ(path.filename() == "pwned", false) << path;
    if (!entry->is_regular_file()) continue;
    const std::string ending = path.extension().string(), text = ReadFile(path);
    SCOPED_TRACE(path.lexically_relative(folder).string());
    if (ending == ".html" || ending == ".svg") {
      EXPECT_EQ(text.find_first_of("\x01\x07\x08\x1b\x7f"), text.npos);
      EXPECT_TRUE(IsUtf8(text));
      for (const auto& [what, count] : CountMarkup(text)) {
        if (is_reference_) markup_[what] = count;
        EXPECT_GT(markup_[what], 0) << what;
      }
    } else if (ending == ".csv" && path.parent_path() != folder) {
      const auto rows = ReadCells(text);
      for (const auto& row : rows) {
        EXPECT_EQ(row.size(), rows[0].size());
        for (const std::string& cell : row) {
          EXPECT_TRUE(cell.empty() ||
                      std::string("=+-@\x1b\t\r").find(cell[0]) == std::string::npos ||
                      IsNumber(cell))
              << cell;
        }
      }
    } else if (ending == ".yaml" || ending == ".json" || ending == ".jsonl") {
      EXPECT_TRUE(IsUtf8(text));
      EXPECT_NO_THROW(YAML::LoadAll(text));
    }
  }
}

TEST_P(GRASPBENCH_SUITE, AreHarmlessInEveryOutput) {
  RunAll(top_ / "plain", "plain");
  CheckFiles(top_ / "plain");
  const int num_all = num_accepted_;
  is_reference_ = false;
  RunAll(top_ / "hostile", GetParam().name);
  CheckFiles(top_ / "hostile");
  std::printf("%d of %d commands accept it\n", num_accepted_, num_all);
  EXPECT_GE(num_accepted_, GetParam().num_accepted);
}

INSTANTIATE_TEST_SUITE_P(Texts, GRASPBENCH_SUITE,
                         testing::ValuesIn(kTexts, kTexts + GRASPBENCH_NUM_TEXTS),
                         [](const auto& instance) { return std::string(instance.param.id); });

}  // namespace
}  // namespace graspbench
