/** @file
Runs the program as a user would and compares what it prints. Each transcripts/<topic>.session
holds cases of the form

    # name: object_show_unknown
    # description: a misspelt object is refused with a suggestion
    # exit: 2
    graspbench object show pencl
    ----
    graspbench: no object "pencl" ...

Commands run in a shell, in an empty folder, with stdout and stderr together; `# exit` (of the last
command) is 0 when absent. `made FOLDER OPTIONS..` is `graspbench run OPTIONS.. --out FOLDER`
without what it prints; the session is made once for all cases and copied. In the expected text
"..." stands for any text within a line and, alone on a line, for any number of lines.
GRASPBENCH_UPDATE_SESSIONS=1 writes what the program prints now into the failing cases: read the
difference before committing it. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/base/files/files.h"
#include "tests/support/transcript.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct SessionCase {
  std::string name;
  std::string description;
  int exit_code = 0;
  std::string commands;
  std::vector<std::string> expected;
};

/** The text after "# key: "; false when the line is another one. */
bool ReadField(const std::string& line, const std::string& key, std::string& value) {
  const std::string head = "# " + key + ": ";
  if (line.rfind(head, 0) != 0) return false;
  value = line.substr(head.size());
  return true;
}

std::vector<SessionCase> ParseSessions(const std::string& text) {
  std::vector<SessionCase> cases;
  bool in_expected = false;
  for (const std::string& line : SplitLines(text)) {
    std::string value;
    if (ReadField(line, "name", value)) {
      cases.push_back({value, "", 0, "", {}});
      in_expected = false;
    } else if (cases.empty()) {
      continue;
    } else if (in_expected) {
      cases.back().expected.push_back(line);
    } else if (ReadField(line, "description", value)) {
      cases.back().description = value;
    } else if (ReadField(line, "exit", value)) {
      cases.back().exit_code = std::stoi(value);
    } else if (line == "----") {
      in_expected = true;
    } else {
      cases.back().commands += line + "\n";
    }
  }
  for (SessionCase& c : cases) DropEmptyTail(c.expected);
  return cases;
}

std::string FormatSessions(const std::vector<SessionCase>& cases) {
  std::string text;
  for (const SessionCase& c : cases) {
    text += (text.empty() ? "" : "\n") + ("# name: " + c.name) +
            "\n# description: " + c.description + "\n" +
            (c.exit_code ? "# exit: " + std::to_string(c.exit_code) + "\n" : "") + c.commands +
            "----\n" + JoinLines(c.expected);
  }
  return text;
}

struct Answer {
  int exit_code = -1;
  std::vector<std::string> lines;
};

/** Where `made` keeps its sessions: those of another build of the program are not used. */
fs::path MakeStoreOfSessions() {
  const fs::path all = fs::path(GRASPBENCH_PROGRAM_FOLDER) / "tests" / "made_sessions";
  const fs::path program = fs::path(GRASPBENCH_PROGRAM_FOLDER) / "graspbench";
  const auto built = fs::last_write_time(program).time_since_epoch().count();
  const fs::path store =
      all / (std::to_string(fs::file_size(program)) + "_" + std::to_string(built));
  fs::create_directories(store);
  return store;
}

constexpr char kMade[] = R"(made() {
  folder=$1; shift
  store=$STORE/$(echo "$*" | cksum | cut -d ' ' -f 1)
  (
    flock 9
    if ! [ -d "$store" ]; then
      graspbench run "$@" --out "$store.new" >/dev/null 2>&1
      mv "$store.new" "$store"
    fi
  ) 9>"$store.lock"
  cp -r "$store" "$folder"
}
)";

Answer RunCommands(const SessionCase& c) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("session_" + c.name + "_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder / "work");
  WriteFileAtomically(folder / "commands", "cd '" + (folder / "work").string() + "'\nPATH='" +
                                               GRASPBENCH_PROGRAM_FOLDER + "':$PATH\nSTORE='" +
                                               MakeStoreOfSessions().string() + "'\n" + kMade +
                                               c.commands);
  const fs::path output = folder / "output";
  const int status = std::system(
      ("sh '" + (folder / "commands").string() + "' >'" + output.string() + "' 2>&1 </dev/null")
          .c_str());
  Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : -1, SplitLines(ReadFile(output))};
  DropEmptyTail(answer.lines);
  fs::remove_all(folder);
  return answer;
}

void UpdateCase(const fs::path& file, const std::string& name, const Answer& answer) {
  std::vector<SessionCase> cases = ParseSessions(ReadFile(file));
  for (SessionCase& c : cases) {
    if (c.name != name) continue;
    c.exit_code = answer.exit_code;
    c.expected = answer.lines;
  }
  WriteFileAtomically(file, FormatSessions(cases));
}

class SessionTest : public testing::Test {
 public:
  SessionTest(fs::path file, SessionCase c) : file_(std::move(file)), case_(std::move(c)) {}
  void TestBody() override {
    const Answer answer = RunCommands(case_);
    const bool is_right =
        answer.exit_code == case_.exit_code && Matches(answer.lines, 0, case_.expected, 0);
    if (!is_right && std::getenv("GRASPBENCH_UPDATE_SESSIONS")) {
      UpdateCase(file_, case_.name, answer);
    }
    EXPECT_TRUE(is_right) << case_.description << "\n"
                          << case_.commands << "---- expected, exit " << case_.exit_code << "\n"
                          << JoinLines(case_.expected) << "---- printed, exit " << answer.exit_code
                          << "\n"
                          << JoinLines(answer.lines);
  }

 private:
  fs::path file_;
  SessionCase case_;
};

TEST(SessionFormat, DotsStandForAnyText) {
  EXPECT_TRUE(MatchesLine("took 1.25 s", "took ... s"));
  EXPECT_FALSE(MatchesLine("took 1.25 ms", "took ... s!"));
  EXPECT_TRUE(Matches({"a", "b", "c"}, 0, {"a", "...", "c"}, 0));
  EXPECT_TRUE(Matches({"a", "c"}, 0, {"a", "...", "c"}, 0));
  EXPECT_FALSE(Matches({"a", "b"}, 0, {"a", "...", "c"}, 0));
  EXPECT_FALSE(Matches({"a", "b"}, 0, {"a"}, 0));
}

void RegisterSessions() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(GRASPBENCH_SESSIONS_FOLDER)) {
    if (entry.path().extension() == ".session") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    for (const SessionCase& c : ParseSessions(ReadFile(file))) {
      testing::RegisterTest(("Session_" + file.stem().string()).c_str(), c.name.c_str(), nullptr,
                            nullptr, file.c_str(), 1,
                            [file, c]() -> testing::Test* { return new SessionTest(file, c); });
    }
  }
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  graspbench::RegisterSessions();
  const int status = RUN_ALL_TESTS();
  return testing::UnitTest::GetInstance()->test_to_run_count() == 0 ? 1 : status;
}
