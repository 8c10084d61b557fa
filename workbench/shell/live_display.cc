#include "workbench/shell/live_display.h"

#include <algorithm>
#include <sstream>
#include <thread>

#include "core/base/text/escape.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

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

}  // namespace

std::vector<std::string> ListLiveCards() {
  std::vector<std::string> names = {"off"};
  for (const LiveCard& card : kCards) names.emplace_back(card.name);
  return names;
}

LiveDisplay::LiveDisplay(Shell& shell)
    : shell_(shell),
      start_time_(shell.scene().time()),
      start_(Clock::now()),
      next_(start_ + kRefreshInterval) {}

void LiveDisplay::Say(const std::string& line) {
  shell_.region.Clear();
  PrintResult(line);
}

void LiveDisplay::Tick() {
  if (!shell_.region.can_redraw()) return;
  if (!shell_.live_card.empty()) WaitForTheClock();
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = std::max(next_ + kRefreshInterval, now);
  Show();
}

/** A simulated second lasts a second at least. */
void LiveDisplay::WaitForTheClock() {
  const std::chrono::duration<double> simulated(shell_.scene().time() - start_time_);
  while (Clock::now() - start_ < simulated && !shell_.IsStopped())
    std::this_thread::sleep_for(kNap);
}

LiveDisplay::~LiveDisplay() {
  shell_.region.Clear();
  if (shell_.live_card.empty()) return;
  shell_.region.Show(DrawCard());
  shell_.region.Leave();
}

std::vector<std::string> LiveDisplay::DrawCard() {
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

void LiveDisplay::Show() {
  std::vector<std::string> lines = DrawCard();
  AddLines(FormatStatus(shell_.scene()), lines);
  shell_.region.Show(lines);
}

}  // namespace graspbench
