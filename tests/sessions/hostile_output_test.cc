/** @file
Bytes from foreign files and names never reach the terminal as they are: whatever the real program
prints, to a pipe, has no control character but line feeds and tabs, and is valid UTF-8. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "tests/sessions/test_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

const std::string kRed = "\x1b[31m";
const std::string kBackwards = "\u202e";

class HostileOutput : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& content) {
    WriteFileAtomically(folder_ / name, content);
  }

  /** What the program prints, stdout and stderr together. */
  std::string Run(const std::string& arguments) {
    Write("commands",
          "cd '" + folder_.string() + "'\n'" GRASPBENCH_PROGRAM "' " + arguments + "\n");
    const fs::path output = folder_ / "output";
    const int status = std::system(
        ("sh '" + (folder_ / "commands").string() + "' >'" + output.string() + "' 2>&1 </dev/null")
            .c_str());
    EXPECT_TRUE(WIFEXITED(status)) << arguments;
    return ReadFile(output);
  }

  /** Runs, and expects harmless output in which the culprit is visible. */
  void ExpectShown(const std::string& arguments, const std::string& shown) {
    const std::string text = Run(arguments);
    EXPECT_TRUE(IsUtf8(text)) << arguments;
    for (const char c : text) {
      ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
          << arguments << ": byte " << static_cast<int>(c);
    }
    EXPECT_EQ(text.find(kBackwards), std::string::npos) << arguments;
    EXPECT_NE(text.find(shown), std::string::npos) << arguments << "\n" << text;
  }

  const TestFolder own_{"hostile_output"};
  const fs::path& folder_ = own_.path();
};

TEST_F(HostileOutput, NamesOfFilesAndArguments) {
  ExpectShown("hand check 'no" + kRed + "hand'", "no\\u001b[31mhand");
  ExpectShown("object show 'no\xff\xfething'", "no\\xff\\xfething");
  ExpectShown("report '" + kBackwards + "stluser'", "\\u202estluser");
  ExpectShown("'" + kRed + "run'", "\\u001b[31mrun");
  ExpectShown("mocap info '\a\r.c3d' --json", "\\u0007\\u000d.c3d");
  ExpectShown("run --set 'trials" + kRed + "=3'", "\\u001b[31m");
}

TEST_F(HostileOutput, KeysAndValuesOfYaml) {
  Write("key.yaml", "trials: 1\n\"obj" + kRed + "ects\": can\n");
  ExpectShown("run key.yaml --out s", "");
  Write("escaped.yaml", "\"obj\\e[31mects\": can\n");
  ExpectShown("run escaped.yaml --out s", "\\u001b[31m");
  Write("value.yaml", "objects: \"\\e]0;title\\a\"\n");
  ExpectShown("run value.yaml --out s", "\\u001b]0;title\\u0007");
}

TEST_F(HostileOutput, CellsOfTables) {
  Write("table.csv", "time,x" + kRed + ",y,z\n0,1,2,3\n1,b\x1b]0;title\x07,2,3\n");
  Write("mapping.yaml", "time: time\n\"poi\\e[31mnts\": x\n");
  ExpectShown("mocap info table.csv --mapping mapping.yaml", "\\u001b[31m");
  const std::string head =
      "NO_OF_FRAMES\t3\nNO_OF_CAMERAS\t1\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nNO_OF_ANALOG\t0\n"
      "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2020\nDATA_INCLUDED\t3D\n";
  Write("label.tsv", head + "MARKER_NAMES\tfin" + kRed + "ger\n0\t0\t0\n1\t1\t1\n2\t2\t2\n");
  ExpectShown("mocap info label.tsv", "fin?[31mger");
  ExpectShown("mocap info label.tsv --json", "fin?[31mger");
  Write("cell.tsv", head + "MARKER_NAMES\tfinger\n0\t0\t0\n1\tt" + kRed + "\t1\n2\t2\t2\n");
  ExpectShown("mocap info cell.tsv", "t?[31m");
}

TEST_F(HostileOutput, ParameterNamesOfC3d) {
  Write("good.tsv",
        "NO_OF_FRAMES\t3\nNO_OF_CAMERAS\t1\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nNO_OF_ANALOG\t0\n"
        "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2020\nDATA_INCLUDED\t3D\n"
        "MARKER_NAMES\tfinger\n0\t0\t0\n1\t1\t1\n2\t2\t2\n");
  ExpectShown("mocap convert good.tsv good.c3d", "good.c3d");
  const std::string good = ReadFile(folder_ / "good.c3d");
  int num_changed = 0;
  // Every name that the file holds, one at a time.
  for (const std::string name : {"POINT", "LABELS", "UNITS", "RATE", "SCALE", "finger", "FRAMES"}) {
    for (size_t at = good.find(name); at != std::string::npos; at = good.find(name, at + 1)) {
      std::string bad = good;
      bad.replace(at, 4, "\x1b[1m");
      Write("bad.c3d", bad);
      ExpectShown("mocap info bad.c3d", "");
      ExpectShown("mocap info bad.c3d --json", "");
      ++num_changed;
    }
  }
  EXPECT_GE(num_changed, 6);
  const size_t label = good.find("finger");
  ASSERT_NE(label, std::string::npos);
  std::string bad = good;
  bad.replace(label, 4, "\x1b[1m");
  Write("bad.c3d", bad);
  ExpectShown("mocap info bad.c3d", "?[1mer");
}

}  // namespace
}  // namespace graspbench
