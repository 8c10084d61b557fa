#include "workbench/terminal/terminal_observer.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/proportion.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {

namespace {

std::atomic<bool> is_stop_asked_for{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // so a signal handler may set it

/** Less than the ten seconds after which service managers kill. [s] */
constexpr unsigned kPatience = 8;
constexpr char kGivenUp[] =
    "graspbench: stopped without waiting for running trials. Finished trials are kept: repeat the "
    "command to continue, with --resume where it has that option\n";

extern "C" void OnInterrupt(int) {
  if (is_stop_asked_for.exchange(true)) ::_exit(kExitInterrupted);
  ::alarm(kPatience);
}

extern "C" void OnPatienceOver(int) {
  // Nothing else may be done in a signal handler; every finished trial is on the disk already.
  const ssize_t written = ::write(STDERR_FILENO, kGivenUp, sizeof kGivenUp - 1);
  static_cast<void>(written);
  ::_exit(kExitInterrupted);
}

}  // namespace

void CatchUnlessIgnored(int signal, const struct sigaction& action) {
  struct sigaction former {};
  ::sigaction(signal, nullptr, &former);
  if (former.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
}

const std::atomic<bool>& CatchInterrupts() {
  struct sigaction action {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) CatchUnlessIgnored(signal, action);
  action.sa_handler = OnPatienceOver;
  ::sigaction(SIGALRM, &action, nullptr);
  return is_stop_asked_for;
}

namespace {

constexpr double kWindow = 30.0;             // [s] over which the rate is taken
constexpr double kTerminalInterval = 0.099;  // [s] a little less than the batch's tick
constexpr double kPlainInterval = 10.0;      // [s]
constexpr size_t kMaxWorkersShown = 8;
/** Share of the work before which its time is not estimated: the first trials are no sample. */
constexpr double kFewWork = 0.1;

std::string FormatRemaining(const ProgressState& state) {
  const int num_left = state.num_planned - state.num_done;
  if (num_left == 0) return "done";
  if (std::isinf(state.remaining)) return "";
  if (std::isfinite(state.remaining)) return FormatDuration(state.remaining) + " left";
  if (!(state.rate > 0.0)) return "";
  return FormatDuration(num_left / state.rate) + " left";
}

std::string FormatSuccess(const ProgressState& state) {
  const auto successes = state.outcomes.find(Outcome::kSuccess);
  return MakePlainText(
      FormatRate(successes == state.outcomes.end() ? 0 : successes->second, state.num_done));
}

/** "no contact 3, pushed away 9", broken into lines of at most `width` where there is room. */
std::vector<std::string> FormatFailures(const ProgressState& state, size_t width) {
  std::vector<std::string> lines = {""};
  for (const Outcome outcome : ListOutcomes()) {
    const auto count = state.outcomes.find(outcome);
    if (outcome == Outcome::kSuccess || count == state.outcomes.end()) continue;
    const std::string text = std::string(NameOf(outcome)) + " " + std::to_string(count->second);
    if (!lines.back().empty()) {
      lines.back() += ",";
      if (lines.back().size() + 1 + text.size() + 1 <= width) {
        lines.back() += " ";
      } else {
        lines.emplace_back();
      }
    }
    lines.back() += text;
  }
  if (lines.back().empty()) lines.back() = "none";
  return lines;
}

std::string FormatBar(const ProgressState& state) {
  constexpr int kLength = 30;
  const int filled = state.num_planned > 0 ? kLength * state.num_done / state.num_planned : kLength;
  return "[" + std::string(filled, '#') + std::string(kLength - filled, '-') + "]";
}

void AddOutcomes(const ProgressState& state, size_t width, std::vector<std::string>& lines) {
  lines.push_back("  success  " + FormatSuccess(state));
  std::string head = "  failed   ";
  for (const std::string& text :
       FormatFailures(state, width - std::min<size_t>(width, head.size()))) {
    lines.push_back(head + text);
    head.assign(head.size(), ' ');
  }
}

}  // namespace

void Pace::Add(double time, int num_done) {
  points_.emplace_back(time, num_done);
  while (points_.size() > 2 && points_[1].first <= time - kWindow) points_.pop_front();
}

double Pace::rate() const {
  if (points_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double time = points_.back().first - points_.front().first;
  const int num_done = points_.back().second - points_.front().second;
  return num_done > 0 && time > 0.0 ? num_done / time : std::numeric_limits<double>::quiet_NaN();
}

std::string FormatDuration(double duration) {
  const long seconds = std::lround(std::ceil(duration));
  const long minutes = seconds / 60, hours = minutes / 60;
  if (hours > 0) return std::to_string(hours) + " h " + std::to_string(minutes % 60) + " min";
  if (minutes > 0) return std::to_string(minutes) + " min " + std::to_string(seconds % 60) + " s";
  return std::to_string(seconds) + " s";
}

std::vector<std::string> FormatBlock(const ProgressState& state, int width) {
  const std::string remaining = FormatRemaining(state);
  std::vector<std::string> lines = {
      "  done     " + FormatBar(state) + " " + std::to_string(state.num_done) + " of " +
          std::to_string(state.num_planned) + " " + state.counted,
      "  pace     " + (std::isfinite(state.rate) ? FormatFixed(state.rate, 1) : "-") + " " +
          state.counted + "/s" + (remaining.empty() ? "" : ", " + remaining),
  };
  if (state.tells_success) AddOutcomes(state, static_cast<size_t>(width), lines);
  const size_t num_shown = std::min(state.workers.size(), kMaxWorkersShown);
  for (size_t i = 0; i < num_shown; ++i) {
    lines.push_back("  worker " + std::to_string(i + 1) + " " +
                    (state.workers[i].empty() ? "idle" : state.workers[i]));
  }
  if (num_shown < state.workers.size()) {
    lines.push_back("  and " + std::to_string(state.workers.size() - num_shown) + " more workers");
  }
  for (std::string& line : lines) CutLine(static_cast<size_t>(std::max(width, 1)), line);
  return lines;
}

std::string FormatLine(const ProgressState& state) {
  const std::string remaining = FormatRemaining(state);
  std::string line = std::to_string(state.num_done) + " of " + std::to_string(state.num_planned) +
                     " " + state.counted;
  if (std::isfinite(state.rate)) {
    line += ", " + FormatFixed(state.rate, 1) + " " + state.counted + "/s";
  }
  if (!remaining.empty()) line += ", " + remaining;
  if (!state.preparing.empty()) {
    line += ", preparing the mesh of ";
    for (const std::string& object : state.preparing) {
      line += (object == *state.preparing.begin() ? "" : ", ") + object;
    }
  }
  if (!state.tells_success) return line;
  return line + "; success " + FormatSuccess(state) +
         "; failed: " + FormatFailures(state, std::string::npos).front();
}

ProgressState TerminalObserver::MakeState() const {
  ProgressState state;
  const StageRow& row = RowOf(kStages, stage_.kind);
  state.counted = row.counted;
  state.tells_success = row.tells_success;
  state.num_planned = stage_.num_trials;
  state.outcomes = stage_.before;
  for (const auto& [outcome, count] : status_.outcomes) state.outcomes[outcome] += count;
  state.num_done = std::accumulate(state.outcomes.begin(), state.outcomes.end(), 0,
                                   [](int sum, const auto& item) { return sum + item.second; });
  for (const std::optional<PlannedTrial>& trial : status_.busy) {
    state.workers.push_back(
        trial ? EscapeForTerminal(trial->hand + "  " + trial->object + "  " + trial->grasp,
                                  LineFeeds::kEscape) +
                    "  #" + std::to_string(trial->trial)
              : "");
  }
  for (const auto& [worker, object] : status_.preparing) {
    const std::string name = EscapeForTerminal(object, LineFeeds::kEscape);
    state.preparing.insert(name);
    const auto place = static_cast<size_t>(worker);
    if (place < state.workers.size()) state.workers[place] = "prepares the mesh of " + name;
  }
  state.rate = pace_.rate();
  const double work = status_.work_done + status_.work_left;
  if (work > 0.0) {
    state.remaining = status_.work_done < kFewWork * work
                          ? std::numeric_limits<double>::infinity()
                          : time_ * status_.work_left / status_.work_done;
  }
  return state;
}

void TerminalObserver::Draw() {
  if (region_.can_redraw()) {
    region_.Show(FormatBlock(MakeState(), FindTerminalSize(stream_).columns - 1));
  } else {
    PrintControlled(stream_, FormatLine(MakeState()) + "\n");
  }
}

std::string DescribeTasks(const Stage& stage) {
  const StageRow& row = RowOf(kStages, stage.kind);
  return FormatCount(stage.num_left, row.task, row.tasks) + " to " + row.verb;
}

TerminalObserver::TerminalObserver(std::function<std::string(const Stage&)> describe,
                                   const std::atomic<bool>& stop, std::FILE* stream)
    : Observer(stop), describe_(std::move(describe)), stream_(stream), region_(stream) {}

void TerminalObserver::BeginStage(const Stage& stage) {
  if (describe_) PrintMessage(describe_(stage));
  if (stage.num_left == 0) return;
  region_.Leave();
  start_ = std::chrono::steady_clock::now();
  stage_ = stage;
  status_ = {};
  pace_ = {};
  last_shown_ = region_.can_redraw() ? -kTerminalInterval : 0.0;
}

void TerminalObserver::ShowStatus(const BatchStatus& status, int num_trials) {
  if (stop() && !has_told_) {
    region_.Clear();
    PrintControlled(stream_, "stopping after the current trials; press again to abort\n");
    has_told_ = true;
  }
  ShowAt(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(), status,
         num_trials);
}

void TerminalObserver::ShowAt(double time, const BatchStatus& status, int num_trials) {
  stage_.num_trials = num_trials;
  status_ = status;
  time_ = time;
  pace_.Add(time, status.num_done);
  if (time - last_shown_ < (region_.can_redraw() ? kTerminalInterval : kPlainInterval)) return;
  last_shown_ = time;
  Draw();
}

void TerminalObserver::EndStage() {
  status_.busy.clear();
  status_.preparing.clear();
  Draw();
  region_.Leave();
}

}  // namespace graspbench
