#pragma once
/** @file
A shell that is given lines nobody would think of: words of its commands in any order, bytes, cut and
glued lines. What is refused must change nothing. */

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/random.h"
#include "core/base/text/text.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_commands.h"

namespace graspbench {

/** Stdout and stderr go nowhere while it lives. */
class Silence {
 public:
  Silence() {
    std::fflush(stdout);
    std::fflush(stderr);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    for (int i : {0, 1}) {
      kept_[i] = ::dup(i + 1);
      ::dup2(nowhere, i + 1);
    }
    ::close(nowhere);
  }
  ~Silence() {
    std::fflush(stdout);
    std::fflush(stderr);
    for (int i : {0, 1}) {
      ::dup2(kept_[i], i + 1);
      ::close(kept_[i]);
    }
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int kept_[2];
};

/** All that a command can change. */
inline std::string DescribeShell(Shell& shell) {
  const SceneChoice& choice = shell.scene().choice();
  std::string text = ToJson(choice.config).dump() + choice.folder + shell.live_card;
  const auto add = [&text](double number) { text += " " + std::to_string(number); };
  add(choice.draw.value_or(-1));
  if (choice.place) {
    for (const double x : {choice.place->x, choice.place->y, choice.place->yaw}) add(x);
  }
  if (choice.hand_place) {
    for (int i = 0; i < 3; ++i)
      add(choice.hand_place->shift[i] + 10.0 * choice.hand_place->angles[i]);
  }
  if (choice.learned) text += choice.learned->id;
  for (const JointEdit& edit : choice.joints) {
    text += edit.joint + (edit.is_target ? "t" : "p");
    add(edit.position);
  }
  for (const DriveEdit& edit : choice.drives) {
    text += edit.joint;
    add(edit.time);
    add(edit.position);
  }
  add(shell.num_changes());
  add(shell.trials ? static_cast<double>(shell.trials->results.size()) : -1.0);
  add(shell.scene().time());
  const WorldState& state = shell.scene().course().world().state();
  text.append(reinterpret_cast<const char*>(state.q.data()),
              static_cast<size_t>(state.q.size()) * sizeof(double));
  text.append(reinterpret_cast<const char*>(state.p_WOcm.data()), 3 * sizeof(double));
  return text;
}

class LineGenerator {
 public:
  LineGenerator(const std::string& seed, Shell& shell) : random_("shell lines", seed) {
    for (const ShellCommand& command : ListShellCommands()) {
      commands_.emplace_back(command.name);
      if (!command.list_names) continue;
      for (size_t index : {0u, 1u, 2u}) {
        for (const std::string& name : command.list_names(shell, index)) words_.push_back(name);
      }
    }
    for (const char* word :
         {"-1",       "0",    "1",        "3",    "7",       "12.5deg", "5mm",   "0.2s",
          "0.7",      "1e5",  "1e308",    "nan",  "inf",     "-0",      "0x10",  "1e-300",
          "to",       "none", "'",        "\"",   "#",       ";",       "%s%n",  "../..",
          "/nowhere", "a/b",  "\xff\xfe", "true", "\x1b[2J", "all",     "x.txt", "light bulb",
          "Light",    "Bulb", "g9",       "?"}) {
      words_.emplace_back(word);
    }
  }

  std::string Next() {
    std::string line = Draw(10) == 0 ? MakeBytes() : MakeWords();
    if (Draw(20) == 0 && !line.empty()) line.resize(Draw(line.size()));
    if (Draw(20) == 0) line += MakeBytes();
    if (Draw(5000) == 0) line += std::string(100000, 'a');
    return line;
  }

 private:
  size_t Draw(size_t count) {
    return static_cast<size_t>(random_.NextUniform(0.0, 1.0) * static_cast<double>(count));
  }
  std::string MakeBytes() {
    std::string bytes;
    for (size_t i = Draw(30); i > 0; --i) bytes += static_cast<char>(Draw(256));
    return bytes;
  }
  std::string MakeWords() {
    std::string line = commands_[Draw(commands_.size())];
    for (size_t i = Draw(5); i > 0; --i) line += " " + words_[Draw(words_.size())];
    return line;
  }

  RandomStream random_;
  std::vector<std::string> commands_, words_;
};

struct FuzzCount {
  int num_refused = 0, num_done = 0;
};

/** Whether a line draws or runs many trials when it is carried out, or ends the shell. No line of
the generator names a file that would be written. */
inline bool IsCostly(const std::string& line) {
  std::string word, first;
  std::istringstream words(line);
  words >> word >> first;
  word = ToLower(word);
  const auto may_be = [&word](const char* command, size_t at_least) {
    return word.size() >= at_least && std::string(command).rfind(word, 0) == 0;
  };
  return may_be("view", 1) || may_be("trials", 2) || may_be("judge", 2) || may_be("why", 1) ||
         (may_be("run", 2) && first == "all") ||
         (may_be("optimise", 2) && (first == "1" || first == "2"));
}
inline bool MayEnd(const std::string& line) {
  const std::string text = ToLower(line);
  const size_t first = std::min(text.find_first_not_of(" \t\r'\""), text.size());
  return text[first] == 'q' || text.compare(first, 4, "exit") == 0;
}

/** Short trials with long steps; a command that goes on costs little then. */
inline void MakeCheap(Shell& shell) {
  for (const char* line :
       {"set strategy.hold_time_s 0.1", "set strategy.lift_time_s 0.1", "set sim.step_s 0.004",
        "set strategy.stabilisation_min_time_s 0.05", "set strategy.stabilisation_max_time_s 0.1",
        "set strategy.closure_time_s 0.2", "set strategy.placing_time_s 0.1"}) {
    EXPECT_EQ(shell.Execute(line), Shell::Reply::kDone) << line;
  }
}

/** Of the costly lines one in 500 is carried out. */
inline FuzzCount FuzzShell(Shell& shell, const std::string& seed, int num_lines) {
  MakeCheap(shell);
  const auto describe_cost = [&shell] {
    const SessionConfig& config = shell.scene().choice().config;
    return ConfigToJson(config.strategy).dump() + ConfigToJson(config.sim).dump();
  };
  const std::string cheap = describe_cost();
  LineGenerator lines(seed, shell);
  FuzzCount count;
  int num_costly = 0;
  std::string before = DescribeShell(shell);
  while (count.num_refused + count.num_done < num_lines && !testing::Test::HasFailure()) {
    const std::string line = lines.Next();
    if (MayEnd(line) || (IsCostly(line) && ++num_costly % 500 != 0)) continue;
    const Shell::Reply reply = shell.Execute(line);
    const std::string after = DescribeShell(shell);
    if (reply == Shell::Reply::kRefused) {
      ++count.num_refused;
      EXPECT_EQ(after, before) << line;
      continue;
    }
    ++count.num_done;
    if (describe_cost() != cheap) shell.Execute("undo");
    before = DescribeShell(shell);
  }
  return count;
}

}  // namespace graspbench
