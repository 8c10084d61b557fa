#include "workbench/shell/line_editor.h"

#include <errno.h>
#include <histedit.h>
#include <locale.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

constexpr int kHistorySize = 1000;
constexpr size_t kListWidth = 78;

termios first_settings;
std::atomic<bool> has_settings{false};

/** What all candidates begin with. */
std::string FindCommonHead(const std::vector<std::string>& names) {
  std::string head = names.front();
  for (const std::string& name : names) {
    const auto mismatch = std::mismatch(head.begin(), head.end(), name.begin(), name.end());
    head.erase(mismatch.first, head.end());
  }
  return head;
}

/** In lines, with one before and one behind. */
std::string FormatNames(const std::vector<std::string>& names) {
  std::string text = "\n";
  size_t width = 0;
  for (const std::string& name : names) {
    if (width > 0 && width + name.size() > kListWidth) {
      text += "\n";
      width = 0;
    }
    text += name + "  ";
    width += name.size() + 2;
  }
  return text + "\n";
}

}  // namespace

struct LineEditor::Impl {
  EditLine* editor = nullptr;
  History* history = nullptr;
  std::function<std::string()> make_prompt;
  std::string prompt;
  Completer completer;
  std::filesystem::path history_file;

  void LoadHistory();
  /** Whole or not at all, so that a killed shell leaves that of the line before. */
  void SaveHistory();

  static Impl& Of(EditLine* editor) {
    void* self = nullptr;
    el_get(editor, EL_CLIENTDATA, &self);
    return *static_cast<Impl*>(self);
  }
  static char* Prompt(EditLine* editor) { return Of(editor).prompt.data(); }
  static unsigned char Complete(EditLine* editor, int) {
    Impl& self = Of(editor);
    const LineInfo* info = el_line(editor);
    const std::string line(info->buffer, info->cursor);
    const std::vector<std::string> names = self.completer(line);
    if (names.empty()) return CC_ERROR;
    const std::string word = line.substr(line.find_last_of(" \t") + 1);
    std::string rest = FindCommonHead(names).substr(word.size());
    if (names.size() == 1) rest += ' ';
    if (!rest.empty()) {
      el_insertstr(editor, rest.c_str());
      return CC_REFRESH;
    }
    PrintResult(FormatNames(names));
    return CC_REDISPLAY;
  }
};

void LineEditor::Impl::LoadHistory() {
  if (history_file.empty()) return;
  HistEvent event;
  ::history(history, &event, H_LOAD, history_file.c_str());
}

void LineEditor::Impl::SaveHistory() {
  if (history_file.empty()) return;
  std::error_code status;
  std::filesystem::create_directories(history_file.parent_path(), status);
  const std::string part = history_file.string() + ".part-" + std::to_string(::getpid());
  HistEvent event;
  const mode_t mask = ::umask(S_IRWXG | S_IRWXO);
  const bool is_written = ::history(history, &event, H_SAVE, part.c_str()) >= 0;
  ::umask(mask);
  if (is_written) std::filesystem::rename(part, history_file, status);
  if (!is_written || status) std::filesystem::remove(part, status);
}

std::filesystem::path FindHistoryFile() {
  const char* states = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (states && *states == '/') {
    folder = states;
  } else if (home && *home == '/') {
    folder = std::filesystem::path(home) / ".local" / "state";
  } else {
    return {};
  }
  return folder / "graspbench" / "history";
}

void RestoreTerminal() {
  if (has_settings) ::tcsetattr(STDIN_FILENO, TCSANOW, &first_settings);
}

LineEditor::LineEditor(std::function<std::string()> prompt, Completer completer,
                       const std::filesystem::path& history_file)
    : impl_(std::make_unique<Impl>()) {
  if (!has_settings) has_settings = ::tcgetattr(STDIN_FILENO, &first_settings) == 0;
  // Its characters alone: numbers stay as they are. Without it every letter beyond ASCII is dropped.
  if (!::setlocale(LC_CTYPE, "C.UTF-8")) ::setlocale(LC_CTYPE, "");
  impl_->make_prompt = std::move(prompt);
  impl_->completer = std::move(completer);
  impl_->history_file = history_file;
  impl_->editor = el_init("graspbench", stdin, stdout, stderr);
  impl_->history = history_init();
  HistEvent event;
  history(impl_->history, &event, H_SETSIZE, kHistorySize);
  history(impl_->history, &event, H_SETUNIQUE, 1);
  impl_->LoadHistory();
  EditLine* editor = impl_->editor;
  el_set(editor, EL_CLIENTDATA, impl_.get());
  el_set(editor, EL_SIGNAL, 1);  // a new size of the window, Ctrl-Z and back
  el_set(editor, EL_PROMPT, &Impl::Prompt);
  el_set(editor, EL_EDITOR, "emacs");
  el_set(editor, EL_HIST, &history, impl_->history);
  el_set(editor, EL_ADDFN, "complete", "complete a name", &Impl::Complete);
  el_set(editor, EL_BIND, "^I", "complete", nullptr);
  el_set(editor, EL_BIND, "^R", "em-inc-search-prev", nullptr);
}

LineEditor::~LineEditor() {
  history_end(impl_->history);
  el_end(impl_->editor);
}

std::optional<std::string> LineEditor::Read() {
  int length = 0;
  impl_->prompt = impl_->make_prompt();
  errno = 0;
  const char* text = el_gets(impl_->editor, &length);
  if (text == nullptr || length <= 0) {
    if (errno != EINTR) return std::nullopt;
    el_reset(impl_->editor);
    PrintResult("^C\n");
    return "";
  }
  std::string line(text, static_cast<size_t>(length));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
  HistEvent event;
  if (!line.empty()) {
    history(impl_->history, &event, H_ENTER, line.c_str());
    impl_->SaveHistory();
  }
  return line;
}

}  // namespace graspbench
