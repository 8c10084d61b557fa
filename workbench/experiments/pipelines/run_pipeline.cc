#include "workbench/experiments/pipelines/run_pipeline.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/file_lock.h"
#include "datasets/journal/store_kind.h"
#include "datasets/pipeline/stable_files.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** A stage of a pipeline as a process of this program. */
class PipelineProcess {
 public:
  /** Starts `graspbench WORDS` in the folder. It ends when this program does, however that ends.
  @param output  file for what it prints; @param log  for what it says, or for both: the same file.
  @throws Error(kIo, kEnvironment). */
  PipelineProcess(const std::vector<std::string>& words, const std::filesystem::path& folder,
                  const std::filesystem::path& output, const std::filesystem::path& log);
  /** Kills it unless it has ended. */
  ~PipelineProcess();
  PipelineProcess(const PipelineProcess&) = delete;
  PipelineProcess& operator=(const PipelineProcess&) = delete;

  /** Its exit code when it has ended, 128 and the signal when that ended it. */
  std::optional<int> Poll();
  /** Asks it to end soon, so that it can be resumed. */
  void Interrupt() const;

 private:
  pid_t process_ = -1;
};

constexpr int kCannotStart = 127;

int OpenForStage(const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (file >= 0) return file;
  throw Error(ErrorKind::kIo, "cannot write \"" + path.string() + "\": " + std::strerror(errno));
}

/** Between fork and exec: nothing that takes memory or locks. */
[[noreturn]] void BecomeStage(char* const* argv, const char* folder, int output, int log,
                              pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool is_ready = ::getppid() == parent && nothing >= 0 && ::dup2(nothing, 0) >= 0 &&
                        ::dup2(output, 1) >= 0 && ::dup2(log, 2) >= 0 && ::chdir(folder) == 0;
  // A terminal's Ctrl-C is for the pipeline, which asks its stages to end.
  ::setpgid(0, 0);
  if (is_ready) ::execv("/proc/self/exe", argv);
  ::_exit(kCannotStart);
}

PipelineProcess::PipelineProcess(const std::vector<std::string>& words, const fs::path& folder,
                                 const fs::path& output, const fs::path& log) {
  std::vector<std::string> texts = {"graspbench"};
  texts.insert(texts.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  const int log_file = OpenForStage(log);
  int output_file = log_file;
  try {
    if (output != log) output_file = OpenForStage(output);
  } catch (...) {
    ::close(log_file);
    throw;
  }
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) BecomeStage(argv.data(), folder.c_str(), output_file, log_file, parent);
  const int reason = errno;
  if (output_file != log_file) ::close(output_file);
  ::close(log_file);
  if (process_ < 0) {
    throw Error(ErrorKind::kEnvironment,
                std::string("cannot start a stage: ") + std::strerror(reason));
  }
}

PipelineProcess::~PipelineProcess() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> PipelineProcess::Poll() {
  int status = 0;
  const pid_t ended = ::waitpid(process_, &status, WNOHANG);
  if (ended != process_) return std::nullopt;
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void PipelineProcess::Interrupt() const {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

constexpr char kRunLock[] = ".lock";
constexpr char kBegun[] = ".begun-";  // and the stage: which key its folder is being made for
constexpr char kSetAside[] = ".set-aside";

bool HasOption(const PipelineStage& stage, const std::string& name) {
  return std::any_of(stage.command.options.begin(), stage.command.options.end(),
                     [&](const StageOption& option) { return option.name == name; });
}

/** Turns the library's faults into ours. */
template <class Work>
auto WithFolders(const Work& work) {
  try {
    return work();
  } catch (const fs::filesystem_error& fault) {
    throw Error(ErrorKind::kIo,
                "cannot use \"" + fault.path1().string() + "\": " + fault.code().message());
  }
}

bool Contains(const fs::path& outer, const fs::path& inner) {
  const auto mismatch = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return mismatch.first == outer.end();
}

/** Nothing, or what a run leaves that was killed at once. */
bool IsNew(const fs::path& results) {
  if (!fs::exists(results)) return true;
  const fs::directory_iterator entries(results);
  return std::all_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    const bool is_half = name.rfind(kPipelineLock, 0) == 0;  // written beside its place
    const bool is_lock = name == kRunLock && entry.file_size() == 0;
    return entry.is_regular_file() && (is_half || is_lock || name == kRunLock + kOwnerEnding);
  });
}

/** Before anything is made there. @throws Error(kUsage, kFormat). */
void CheckResults(const Pipeline& pipeline, const fs::path& results) {
  // Whoever removes the lock file asks for every stage again.
  const bool was_ours = fs::exists(results / kRunLock) && fs::is_directory(results / kStageLogs);
  const bool is_ours = IsNew(results) || fs::exists(results / kPipelineLock) || was_ours;
  if (!is_ours || fs::is_symlink(results / kRunLock) || fs::is_symlink(results / kPipelineLock)) {
    throw Error(ErrorKind::kUsage,
                "\"" + results.string() +
                    "\" holds files other than pipeline results; name a new or empty folder");
  }
  LoadPipelineLock(results);  // a file of that name may be somebody else's
  const fs::path place = fs::weakly_canonical(fs::absolute(results));
  for (const PipelineStage& stage : pipeline.stages) {
    for (const StageInput& input : stage.inputs) {
      if (!input.stage.empty()) continue;
      const fs::path path =
          fs::weakly_canonical(fs::absolute(fs::path(pipeline.folder) / input.path));
      if (Contains(path, place) || Contains(place, path)) {
        throw Error(ErrorKind::kUsage,
                    "the results in \"" + results.string() + "\" and the input \"" + input.path +
                        "\" contain each other; name another folder for the results");
      }
    }
  }
}

/** What the stages read of the user's, by the names that their command lines have for it. */
void LinkInputs(const Pipeline& pipeline, const fs::path& results) {
  const fs::path links = results / kStageInputs;
  fs::remove_all(links);
  std::set<std::string> inputs;  // an outer one before those in it
  for (const PipelineStage& stage : pipeline.stages) {
    for (const StageInput& input : stage.inputs) {
      if (input.stage.empty()) inputs.insert(input.path);
    }
  }
  for (const std::string& input : inputs) {
    const fs::path link = links / input;
    if (fs::exists(link)) continue;  // in a folder that is linked
    fs::create_directories(link.parent_path());
    fs::create_symlink(fs::absolute(fs::path(pipeline.folder) / input), link);
  }
}

void SetAside(const fs::path& folder) {
  fs::path target = folder.string() + kSetAside;
  for (int i = 2; fs::exists(fs::symlink_status(target)); ++i) {
    target = folder.string() + kSetAside + "-" + std::to_string(i);
  }
  fs::rename(folder, target);
}

class PipelineRunner {
 public:
  PipelineRunner(const Pipeline& pipeline, const PipelineRequest& request,
                 const std::atomic<bool>& stop)
      : pipeline_(pipeline), request_(request), stop_(stop), results_(request.results) {}

  std::vector<std::string> Run() {
    lock_ = LoadPipelineLock(results_);
    if (!fs::exists(results_ / kPipelineLock)) WritePipelineLock(results_, lock_);
    LinkInputs(pipeline_, results_);
    MakeFolder(results_ / kStageLogs);
    for (;;) {  // a stage that gives other bytes than before makes those behind it stale
      waiting_.clear();
      for (StageState& state : FindStageStates(pipeline_, results_, lock_, request_.program)) {
        if (!state.IsFresh()) waiting_.push_back(std::move(state));
      }
      if (waiting_.empty()) {
        // Of a stage whose end was noted just before the program was killed.
        for (const PipelineStage& stage : pipeline_.stages) {
          fs::remove(results_ / (kBegun + stage.name));
        }
        return ended_;
      }
      RunWaiting();
    }
  }

 private:
  struct Running {
    StageState state;
    std::unique_ptr<PipelineProcess> process;
    std::chrono::steady_clock::time_point start;
  };

  void RunWaiting() {
    while (!waiting_.empty() || !running_.empty()) {
      if (!stop_ && fault_.empty()) StartReady();
      if (running_.empty()) break;
      if (stop_ && !is_interrupted_) {
        for (const Running& running : running_) running.process->Interrupt();
        is_interrupted_ = true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      FinishEnded();
    }
    if (!fault_.empty() && fault_kind_ != ErrorKind::kInterrupted) throw Error(fault_kind_, fault_);
    if (stop_ || !fault_.empty()) {
      throw Error(ErrorKind::kInterrupted, "interrupted; repeat the command to continue");
    }
  }

  bool IsWaitedFor(const std::string& stage) const {
    const auto is_it = [&](const StageState& state) { return state.stage == stage; };
    return std::any_of(waiting_.begin(), waiting_.end(), is_it) ||
           std::any_of(running_.begin(), running_.end(),
                       [&](const Running& running) { return is_it(running.state); });
  }

  void StartReady() {
    std::vector<StageState> ready;
    const auto num_free =
        static_cast<size_t>(std::max(1, request_.num_workers)) -
        std::min(running_.size(), static_cast<size_t>(std::max(1, request_.num_workers)));
    for (const StageState& state : waiting_) {
      const std::vector<std::string> needed = pipeline_.Find(state.stage)->ListNeeded();
      const bool is_ready = std::none_of(
          needed.begin(), needed.end(), [&](const std::string& name) { return IsWaitedFor(name); });
      if (is_ready && ready.size() < num_free) ready.push_back(state);
    }
    const int num_jobs = ready.empty() ? 1 : static_cast<int>(num_free / ready.size());
    for (StageState& state : ready) {
      waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const StageState& one) { return one.stage == state.stage; }));
      Start(std::move(state), num_jobs);
    }
  }

  void Start(StageState state, int num_jobs) {
    ForgetFailure(results_, state.stage);
    const PipelineStage& stage = *pipeline_.Find(state.stage);
    const fs::path log = results_ / kStageLogs / (stage.name + ".txt");
    std::vector<std::string> words = ListStageWords(stage);
    const bool is_resumed = Prepare(stage, state);
    if (is_resumed) {  // with its own settings, which are those of the key
      words = {stage.command.name, "--resume", "--out=" + stage.name};
    }
    std::string line;
    for (const std::string& word : words) line += " " + QuoteForShell(word);
    request_.tell(stage.name + ": graspbench" + line);
    if (HasOption(stage, "jobs")) words.push_back("--jobs=" + std::to_string(num_jobs));
    const fs::path output =
        stage.command.place == StagePlace::kText ? results_ / stage.name / kStageOutput : log;
    running_.push_back({std::move(state),
                        std::make_unique<PipelineProcess>(words, results_, output, log),
                        std::chrono::steady_clock::now()});
  }

  /** Makes room for the stage's result and what it starts from.
  @returns whether an interrupted one can go on. */
  bool Prepare(const PipelineStage& stage, const StageState& state) {
    const fs::path folder = results_ / stage.name, begun = results_ / (kBegun + stage.name);
    const std::string key = CalcStageKey(state.facts);
    const bool has_begun = fs::exists(begun);
    if (has_begun && HasOption(stage, "resume") && ReadFile(begun) == key &&
        FindStoreKind(folder)) {
      return true;
    }
    if (fs::exists(fs::symlink_status(folder))) {
      const bool is_own = has_begun || (lock_.count(stage.name) > 0 && !state.is_edited);
      if (!is_own) {
        SetAside(folder);
        request_.tell(stage.name + ": the earlier content is kept as " + stage.name + kSetAside);
      }
      WriteFileAtomically(begun, "being removed");
      fs::remove_all(folder);
    }
    if (stage.command.place == StagePlace::kCopy) {
      WriteFileAtomically(begun, "being copied");
      const std::string copied = FindCopied(stage);
      const fs::path from =
          pipeline_.Find(copied) ? results_ / copied : results_ / kStageInputs / copied;
      fs::copy(fs::canonical(from), folder, fs::copy_options::recursive);
    } else if (stage.command.place == StagePlace::kText) {
      fs::create_directory(folder);
    }
    WriteFileAtomically(begun, key);
    return false;
  }

  void FinishEnded() {
    for (size_t i = 0; i < running_.size();) {
      std::optional<int> code = running_[i].process->Poll();
      if (!code) {
        ++i;
        continue;
      }
      // It was asked to end before it could say how it does that.
      if (is_interrupted_ && *code == 128 + SIGTERM) code = kExitInterrupted;
      const Running running = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      if (*code == kExitOk || *code == kExitNumericalFailures) {
        Keep(running);
      } else {
        KeepFault(running.state.stage, *code);
        if (*code != kExitInterrupted && !stop_) KeepFailure(results_, running.state.stage, *code);
      }
    }
  }

  void Keep(const Running& running) {
    const std::string& name = running.state.stage;
    lock_[name] = MakeLockedStage(*pipeline_.Find(name), running.state.facts, results_, lock_);
    SyncFileSystem(results_);
    WritePipelineLock(results_, lock_);
    fs::remove(results_ / (kBegun + name));
    ended_.push_back(name);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - running.start;
    request_.tell(name + ": done, " + FormatFixed(time.count(), 1) + " s");
  }

  void KeepFault(const std::string& stage, int code) {
    if (!fault_.empty() && fault_kind_ != ErrorKind::kInterrupted) return;
    const fs::path log = results_ / kStageLogs / (stage + ".txt");
    constexpr size_t kMaxShown = 600;
    std::string said = ReadFile(log);
    if (said.size() > kMaxShown) said = ".." + said.substr(said.size() - kMaxShown);
    while (!said.empty() && said.back() == '\n') said.pop_back();
    fault_kind_ = code == kExitUsage         ? ErrorKind::kUsage
                  : code == kExitBadInput    ? ErrorKind::kFormat
                  : code == kExitInterrupted ? ErrorKind::kInterrupted
                                             : ErrorKind::kEnvironment;
    fault_ = "the stage " + stage + " failed with exit code " + std::to_string(code) +
             "; its message, from \"" + log.string() + "\":\n" + said;
  }

  const Pipeline& pipeline_;
  const PipelineRequest& request_;
  const std::atomic<bool>& stop_;
  const fs::path results_;
  PipelineLock lock_;
  std::vector<StageState> waiting_;
  std::vector<Running> running_;
  std::vector<std::string> ended_;
  std::string fault_;
  ErrorKind fault_kind_ = ErrorKind::kInterrupted;
  bool is_interrupted_ = false;
};

}  // namespace

StageFacts FindProgramFacts() {
  const fs::path root = FindDataRoot();
  std::string data;
  for (const char* folder : {"core/hand/models", "objects/catalogue"}) {
    data += CalcStableSha256(ListStableFiles(root / folder));
  }
  return {{"program", FindBuild()}, {"data", data}};
}

std::vector<std::string> RunPipeline(const Pipeline& pipeline, const PipelineRequest& request,
                                     const std::atomic<bool>& stop) {
  return WithFolders([&] {
    CheckResults(pipeline, request.results);
    MakeFolder(request.results);
    const AppendFile lock(request.results / kRunLock,
                          "another graspbench pipeline run is active in \"" +
                              request.results.string() +
                              "\"; wait until it is finished or stop it");
    return PipelineRunner(pipeline, request, stop).Run();
  });
}

}  // namespace graspbench
