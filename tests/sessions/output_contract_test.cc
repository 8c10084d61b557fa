/** @file
No writing command touches what is not its own: for every command and every bad place for its
output, the real program refuses with the exit code of a wrong use and every file that was there
before is there afterwards, byte for byte. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "tests/sessions/test_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

enum class Kind { kFolder, kFile, kOwnFolder };

struct WritingCommand {
  const char* name;
  const char* line;  ///< OUT stands for the output, IN for the folder of the input
  Kind kind;         ///< kOwnFolder: writes into the result that it is given
};

void PrintTo(const WritingCommand& command, std::ostream* out) { *out << command.name; }

const WritingCommand kCommands[] = {
    {"run", "run IN/session.yaml --out OUT", Kind::kFolder},
    {"run_resume", "run IN/session.yaml --resume --out OUT", Kind::kFolder},
    {"campaign",
     "campaign --hand tum --object golf_ball --evaluations 1 --trials 1 --set "
     "optimise.choice_trials=1 --set optimise.check_pairs=20 --out OUT",
     Kind::kFolder},
    {"optimise", "optimise --hand tum --object golf_ball --evaluations 1 --out OUT", Kind::kFolder},
    {"basin", "basin --hand tum --object golf_ball --grasp IN/g.yaml --samples 1 --out OUT",
     Kind::kFolder},
    {"basin_replace",
     "basin --hand tum --object golf_ball --grasp IN/g.yaml --samples 1 --replace --out OUT",
     Kind::kFolder},
    {"study_run", "study run IN/study.yaml --out OUT", Kind::kFolder},
    {"study_run_replace", "study run IN/study.yaml --replace --out OUT", Kind::kFolder},
    {"study_demo", "study demo --out OUT", Kind::kFolder},
    {"study_demo_replace", "study demo --replace --out OUT", Kind::kFolder},
    {"run_plan_only", "run IN/session.yaml --plan-only --out OUT", Kind::kFolder},
    {"work", "work OUT --shard 1/1", Kind::kOwnFolder},
    {"merge", "merge OUT", Kind::kOwnFolder},
    {"submit", "submit OUT --engine local --array 1", Kind::kOwnFolder},
    {"judge", "judge OUT", Kind::kOwnFolder},
    {"sensitivity", "sensitivity OUT --set model.mass_scale=2", Kind::kOwnFolder},
    {"report", "report OUT", Kind::kOwnFolder},
    {"export", "export OUT", Kind::kOwnFolder},
    {"optimise_replay", "optimise --replay 0 --out OUT", Kind::kOwnFolder},
    {"check_numerics", "check-numerics OUT", Kind::kOwnFolder},
    {"check_numerics_out", "check-numerics IN/done --out OUT", Kind::kFile},
    {"mocap_convert", "mocap convert IN/reach.tsv OUT", Kind::kFile},
    {"mocap_plot", "mocap plot IN/reach.tsv OUT", Kind::kFile},
    {"mocap_redact", "mocap redact IN/reach.tsv OUT", Kind::kFile},
    {"render", "render tum golf_ball g1 --out OUT", Kind::kFile},
};

std::string Replace(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/** Names and hashes of all files below a folder; folders too, as "name/". */
std::map<std::string, std::string> TakeInventory(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file()) {
      files[name] = CalcHashHex(ReadFile(entry.path()));
    } else {
      files[name + "/"] = "";
    }
  }
  return files;
}

class OutputContract : public testing::TestWithParam<WritingCommand> {
 protected:
  OutputContract() {
    for (const char* name : {"home", "in", "foreign"}) fs::create_directories(top_ / name);
    Write("home/letter.txt", "dear");
    // The names of the program's own files, but not its files.
    for (const char* name : {"index.html", "trials.csv", "plan.jsonl", "basin.csv", "measures.csv",
                             "manifest.json", "report/index.html", "export/trials.csv"}) {
      Write(std::string("foreign/") + name, std::string("mine: ") + name);
    }
    Write("file.csv", "a file of mine");
    Write("in/session.yaml", "hands: tum\nobjects: golf_ball\ntrials: 1\n");
    Write("in/study.yaml", "markers: {thumb: thumb, index: index}\n");
    Write("in/trials.csv", "participant,file\n01,reach.tsv\n");
    Write("in/reach.tsv",
          "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nDATA_INCLUDED\t3D\n"
          "MARKER_NAMES\tthumb\tindex\n1\t2\t3\t4\t5\t6\n1\t2\t3\t4\t5\t7\n");
  }

  void Write(const std::string& name, const std::string& content) {
    fs::create_directories((top_ / name).parent_path());
    WriteFileAtomically(top_ / name, content);
  }

  /** Exit code; what was printed is kept in printed_. */
  int Run(const std::string& out) {
    std::string line = Replace(GetParam().line, "IN", (top_ / "in").string());
    line = Replace(line, "OUT", out);
    const std::string log = top_.string() + ".log";
    // What one line prepares of a mesh serves the next, in another process.
    const std::string cache =
        fs::path(GRASPBENCH_PROGRAM).replace_filename("contract_cache").string();
    const int status = std::system(
        ("cd '" + top_.string() + "' && HOME='" + (top_ / "home").string() + "' XDG_CACHE_HOME='" +
         cache + "' '" GRASPBENCH_PROGRAM "' " + line + " >'" + log + "' 2>&1 </dev/null")
            .c_str());
    printed_ = ReadFile(log);
    fs::remove(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  void ExpectRefused(const std::string& out) {
    const auto before = TakeInventory(top_);
    const int exit_code = Run(out);
    EXPECT_EQ(exit_code, 2) << "--out " << out << "\n" << printed_;
    EXPECT_EQ(TakeInventory(top_), before) << "--out " << out << "\n" << printed_;
    const std::string named = out == "''" ? "empty name" : "\"" + out + "\"";
    const std::string in_full = out == "." ? "\"" + top_.string() + "\"" : named;
    EXPECT_TRUE(printed_.find(named) != std::string::npos ||
                printed_.find(in_full) != std::string::npos)
        << printed_;  // refused because of it
  }

  const TestFolder own_{"contract_" + std::string(GetParam().name)};
  const fs::path& top_ = own_.path();
  std::string printed_;
};

TEST_P(OutputContract, LeavesEverythingForeignAlone) {
  ExpectRefused("foreign");
  ExpectRefused(top_.string() + "/foreign/");
  ExpectRefused("foreign/../foreign/.");
  ExpectRefused("in");
  ExpectRefused("file.csv");
  ExpectRefused("home");
  ExpectRefused(".");
  ExpectRefused("''");
  ExpectRefused("/");
  // An empty home is still no place for results.
  fs::remove(top_ / "home" / "letter.txt");
  if (GetParam().kind == Kind::kFolder) ExpectRefused("home");
  fs::create_directory_symlink("foreign", top_ / "link");
  ExpectRefused("link");
}

// A person withdraws: the new result takes the place of the old one, and nothing of theirs is left.
TEST(OutputContractOfStudies, AWithdrawnParticipantLeavesNoFile) {
  const TestFolder own("withdrawn");
  const fs::path& top = own.path();
  const auto run = [&](const std::string& line) {
    return std::system(
        ("cd '" + top.string() + "' && '" GRASPBENCH_PROGRAM "' " + line + " >log 2>&1 </dev/null")
            .c_str());
  };
  ASSERT_EQ(run("study demo --out demo"), 0) << ReadFile(top / "log");
  fs::copy(top / "demo" / "input", top / "data", fs::copy_options::recursive);
  ASSERT_EQ(run("study run data/study.yaml --out result"), 0) << ReadFile(top / "log");
  const fs::path bids = top / "result" / "bids";
  ASSERT_TRUE(fs::exists(bids / "sub-03"));

  std::string kept;
  std::istringstream table(ReadFile(top / "data" / "trials.csv"));
  for (std::string line; std::getline(table, line);) {
    if (line.rfind("03,", 0) != 0) kept += line + "\n";
  }
  WriteFileAtomically(top / "data" / "trials.csv", kept);
  EXPECT_NE(run("study run data/study.yaml --out result"), 0) << "without --replace";
  EXPECT_TRUE(fs::exists(bids / "sub-03"));
  ASSERT_EQ(run("study run data/study.yaml --out result --replace"), 0) << ReadFile(top / "log");
  EXPECT_FALSE(fs::exists(bids / "sub-03"));
  EXPECT_TRUE(fs::exists(bids / "sub-02"));
  EXPECT_EQ(ReadFile(bids / "participants.tsv").find("03"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Commands, OutputContract, testing::ValuesIn(kCommands),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace graspbench
