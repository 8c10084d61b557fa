#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/proportion.h"
#include "objects/catalogue.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

constexpr double kLatestTime = 3600.0;  // [s]
constexpr int kMaxSteps = 1000000;

constexpr std::chrono::milliseconds kRefreshInterval(200);
constexpr std::chrono::milliseconds kNap(5);  // Ctrl-C is heard between two
constexpr int kLinesBeside = 3;               // of a picture: its words, the status, the cursor
struct LiveCard {
  const char* name;
  std::string (*format)(ShellScene& scene);  ///< null: the picture
};
constexpr LiveCard kCards[] = {{"contacts", &FormatContacts},
                               {"joints", &FormatJoints},
                               {"timing", &FormatTiming},
                               {"stability", &FormatStability},
                               {"view", nullptr}};

void AddLines(const std::string& text, std::vector<std::string>& lines) {
  std::istringstream stream(EscapeForTerminal(text));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
}

/** What a person sees at a terminal while a trial goes on: a line, or the card that `live` chose,
in real time and five times a second. Elsewhere nothing, and nothing waits. */
class LiveDisplay {
 public:
  explicit LiveDisplay(Shell& shell) : shell_(shell), start_time_(shell.scene().time()) {}
  /** What `live` chose stays as it was in the end. */
  ~LiveDisplay() {
    shell_.region.Clear();
    if (shell_.live_card.empty()) return;
    shell_.region.Show(DrawCard());
    shell_.region.Leave();
  }
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;

  /** To be called after every step. */
  void Tick() {
    if (!shell_.region.can_redraw()) return;
    if (!shell_.live_card.empty()) WaitForTheClock();
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = std::max(next_ + kRefreshInterval, now);
    std::vector<std::string> lines = DrawCard();
    AddLines(FormatStatus(shell_.scene()), lines);
    shell_.region.Show(lines);
  }
  /** A line above it, of something that has happened. */
  void Say(const std::string& line) {
    shell_.region.Clear();
    PrintResult(line);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<std::string> DrawCard() {
    ShellScene& scene = shell_.scene();
    std::vector<std::string> lines;
    for (const LiveCard& card : kCards) {
      if (shell_.live_card != card.name) continue;
      if (card.format) {
        AddLines(card.format(scene), lines);
      } else {
        lines = shell_.painter.DrawLive(scene, SceneView(), kLinesBeside);
        AddLines(DescribeView(scene, SceneView()), lines);
      }
    }
    return lines;
  }
  /** A simulated second lasts a second at least. */
  void WaitForTheClock() {
    const std::chrono::duration<double> simulated(shell_.scene().time() - start_time_);
    while (Clock::now() - start_ < simulated && !shell_.IsStopped()) {
      std::this_thread::sleep_for(kNap);
    }
  }

  Shell& shell_;
  const double start_time_;  // of the trial [s]
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + kRefreshInterval;
};

/** Says what happens while a trial goes on: phases, first touches, the outcome. */
class Narrator {
 public:
  explicit Narrator(Shell& shell) : scene_(shell.scene()), display_(shell) { Catch(); }

  void Tell() {
    const TrialNotes& notes = scene_.notes();
    for (; num_phases_ < notes.result.phases.size(); ++num_phases_) {
      const PhaseStart& phase = notes.result.phases[num_phases_];
      Print(phase.time, phase.name);
    }
    for (size_t d = 0; d < has_touched_.size(); ++d) {
      const DigitContact& contact = notes.result.contacts[d];
      if (has_touched_[d] || std::isnan(contact.time)) continue;
      has_touched_[d] = true;
      Print(contact.time, "first touch of " + contact.digit.str());
    }
    display_.Tick();
  }

 private:
  void Catch() {
    num_phases_ = scene_.notes().result.phases.size();
    for (const DigitContact& contact : scene_.notes().result.contacts) {
      has_touched_.push_back(!std::isnan(contact.time));
    }
  }
  void Print(double time, const std::string& what) {
    display_.Say(fmt::format("{:>8} s  {}\n", FormatFixed(time, 3), what));
  }

  ShellScene& scene_;
  LiveDisplay display_;
  size_t num_phases_ = 0;
  std::vector<bool> has_touched_;
};

/** Until `ends`, the trial's end, or Ctrl-C. */
void Advance(Shell& shell, const std::function<bool()>& ends) {
  ShellScene& scene = shell.scene();
  {
    Narrator narrator(shell);
    bool goes_on = true;
    while (goes_on && !shell.IsStopped()) {
      goes_on = scene.Advance();
      narrator.Tell();
      if (ends()) break;
    }
  }
  PrintResult(FormatStatus(scene));
}

void DemandTimeLeft(Shell& shell) {
  if (!shell.scene().is_over()) return;
  throw Error(ErrorKind::kUsage,
              "the trial has ended; reset, back or goto return to an earlier time");
}

/** Slips and losses from lift-off on: while it closes a finger that touches always slides. */
size_t CountLosses(const ShellScene& scene) {
  const TrialNotes& notes = scene.notes();
  double lift_off = std::numeric_limits<double>::infinity();
  for (const PhaseStart& phase : notes.result.phases) {
    if (phase.name == NameOf(Phase::kLiftOff)) lift_off = phase.time;
  }
  size_t count = 0;
  for (const ContactEvent& event : notes.events.MakeEvents()) {
    const bool is_loss =
        event.kind == ContactEventKind::kSlip || event.kind == ContactEventKind::kLost;
    count += is_loss && event.time >= lift_off;
  }
  return count;
}

size_t CountTouched(const ShellScene& scene) {
  size_t count = 0;
  for (const DigitContact& contact : scene.notes().result.contacts) {
    count += !std::isnan(contact.time);
  }
  return count;
}

}  // namespace

void StepTrial(Shell& shell, const ShellArguments& arguments) {
  DemandTimeLeft(shell);
  int left = arguments.empty() ? 1 : ParseCount(arguments[0], "the number of steps", 1, kMaxSteps);
  Advance(shell, [&left] { return --left == 0; });
}

std::vector<std::string> ListRunTargets() {
  std::vector<std::string> targets = {"end", "slip", "contact"};
  for (const PhaseRow& row : kPhases) {
    if (row.value >= Phase::kPlacing) targets.emplace_back(row.name);
  }
  return targets;
}

namespace {

/** A target by its name or the beginning of a single one. */
std::string FindRunTarget(const std::string& given) {
  std::vector<std::string> found;
  for (const std::string& name : ListRunTargets()) {
    if (name == given) return name;
    if (name.rfind(given, 0) == 0) found.push_back(name);
  }
  if (found.size() == 1) return found.front();
  throw Error(ErrorKind::kUsage, "\"" + given + "\" is not an event to run to" +
                                     SuggestNames(given, ListRunTargets()));
}

/** Whether the scene is there, asked after every step. @throws Error(kUsage) when it was before. */
std::function<bool()> MakeEnding(const ShellScene& scene, const std::string& target) {
  if (target == "end") return [] { return false; };
  if (target == "slip") {
    return [&scene, count = CountLosses(scene)] { return CountLosses(scene) > count; };
  }
  if (target == "contact") {
    return [&scene, count = CountTouched(scene)] { return CountTouched(scene) > count; };
  }
  const Phase phase = RowFromName(kPhases, target, "phase").value;
  if (scene.notes().phase >= phase) {
    throw Error(ErrorKind::kUsage, "the " + target + " has begun; see: goto, reset");
  }
  return [&scene, phase] { return scene.notes().phase >= phase; };
}

void PlayAll(Shell& shell, const SceneChoice& before, const std::string& target) {
  ShellScene& scene = shell.scene();
  SceneChoice choice;
  choice.config = before.config;
  choice.config.grasps = {"best"};
  choice.draw = before.draw;
  int num_played = 0, num_successes = 0;
  for (const std::string& object : ListObjects()) {
    choice.config.objects = {object};
    scene.Choose(choice);
    const std::function<bool()> ends = MakeEnding(scene, target);
    {
      LiveDisplay display(shell);
      while (!shell.IsStopped() && scene.Advance() && !ends()) display.Tick();
    }
    if (shell.IsStopped()) break;
    ++num_played;
    num_successes += scene.is_over() && IsSuccess(scene.course().End().outcome);
    PrintResult(
        fmt::format("{:<16} {:<4} {}", object, scene.setup().grasp.id, FormatStatus(scene)));
  }
  if (target == "end" && num_played > 0) {
    PrintResult(fmt::format("success  {}\n", FormatRate(num_successes, num_played)));
  }
}

/** The hand's best grasp of every object of the catalogue, one after the other, up to there; then
the scene is as it was. */
void RunAll(Shell& shell, const std::string& target) {
  ShellScene& scene = shell.scene();
  const SceneChoice before = scene.choice();
  const double time = scene.time();
  const auto go_back = [&] {
    scene.Choose(before);
    scene.GoTo(time, [] { return false; });
  };
  try {
    PlayAll(shell, before, target);
  } catch (...) {
    go_back();
    throw;
  }
  go_back();
}

}  // namespace

void RunTrial(Shell& shell, const ShellArguments& given) {
  ShellArguments arguments = given;
  const bool is_all = !arguments.empty() && ToLower(arguments.front()) == "all";
  if (is_all) arguments.erase(arguments.begin());
  if (arguments.size() == 3 || (arguments.size() == 2 && ToLower(arguments[0]) != "to")) {
    throw Error(ErrorKind::kUsage, "\"" + arguments[0] + "\" is unknown here; see: help run");
  }
  const std::string target = arguments.empty() ? "end" : FindRunTarget(ToLower(arguments.back()));
  if (is_all) return RunAll(shell, target);
  DemandTimeLeft(shell);
  Advance(shell, MakeEnding(shell.scene(), target));
}

void GoToTime(Shell& shell, const ShellArguments& arguments) {
  const double time = ParseNumber(arguments[0], "the time", "s", 0.0, kLatestTime);
  shell.scene().GoTo(time, [&shell] { return shell.IsStopped(); });
  PrintResult(FormatStatus(shell.scene()));
}

void GoBack(Shell& shell, const ShellArguments& arguments) {
  const double duration =
      arguments.empty() ? 0.1 : ParseNumber(arguments[0], "the time", "s", 0.0, kLatestTime);
  ShellScene& scene = shell.scene();
  scene.GoTo(std::max(0.0, scene.time() - duration), [&shell] { return shell.IsStopped(); });
  PrintResult(FormatStatus(scene));
}

std::vector<std::string> ListLiveCards() {
  std::vector<std::string> names = {"off"};
  for (const LiveCard& card : kCards) names.emplace_back(card.name);
  return names;
}

void ChooseLiveCard(Shell& shell, const ShellArguments& arguments) {
  const std::string name = ToLower(arguments[0]);
  const std::vector<std::string> known = ListLiveCards();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw Error(ErrorKind::kUsage,
                "\"" + arguments[0] + "\" is not a live view" + SuggestNames(name, known));
  }
  shell.live_card = name == "off" ? "" : name;
}

void ResetTrial(Shell& shell, const ShellArguments&) {
  shell.scene().Reset();
  PrintResult(FormatStatus(shell.scene()));
}

}  // namespace graspbench
