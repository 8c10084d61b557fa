#include "workbench/folder_status.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/campaign/check_records.h"
#include "datasets/journal/file_lock.h"
#include "datasets/journal/read_journal.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/tables/progress_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr double kQuiet = 5.0;  // without a new line, before anybody asks who writes it [s]

void AddNote(const std::string& note, FolderStatus& status) {
  status.notes += (status.notes.empty() ? "note: " : "\nnote: ") + note;
}

void AddUnchecked(const std::set<std::string>& labels, FolderStatus& status) {
  if (!labels.empty()) AddNote(DescribeUnchecked(labels), status);
}

void AddDamage(const fs::path& folder, const std::vector<Damage>& damages, int num_bad_lines,
               FolderStatus& status) {
  if (!status.damage.empty() || (damages.empty() && num_bad_lines == 0)) return;
  const std::string lines =
      num_bad_lines > 0
          ? FormatCount(num_bad_lines, "damaged line is", "damaged lines are") + " left out"
          : "\"" + folder.string() + "\" is damaged";
  status.damage =
      lines + "; see graspbench verify " + QuoteForShell(folder.string()) + FormatDamage(damages);
}

/** What `verify` calls damage. */
std::vector<Damage> FindAllDamage(const fs::path& folder) {
  StoreState state = CheckStore(folder);
  CheckRecords(folder, state);
  return state.damages;
}

/** A store may be written meanwhile: a manifest and a file that are read one after the other need
not belong together then. Real damage is there a moment later, too. */
std::vector<Damage> FindLastingDamage(const fs::path& folder) {
  constexpr std::chrono::milliseconds kMoment(100);
  std::vector<Damage> damages = FindAllDamage(folder);
  if (damages.empty()) return damages;
  std::this_thread::sleep_for(kMoment);
  return FindAllDamage(folder);
}

/** Of all regular files in it [bytes]. */
uintmax_t CalcSize(const fs::path& folder) {
  uintmax_t size = 0;
  std::error_code status;
  fs::recursive_directory_iterator entry(folder, status), end;
  for (; !status && entry != end; entry.increment(status)) {
    std::error_code gone;  // while a result is written, files come and go
    const uintmax_t bytes = entry->is_regular_file(gone) ? entry->file_size(gone) : 0;
    if (!gone) size += bytes;
  }
  return size;
}

constexpr char kNobodyWorks[] = "; no process of this machine is working on it";

/** Of journals that no process of this machine writes: since the last line of one [s]. Shards say
of themselves how they are. */
std::optional<double> FindIdleTime(const fs::path& folder, const std::string& subfolder,
                                   const std::vector<ShardProgress>& shards) {
  const std::vector<fs::path> journals = ListJournals(folder, subfolder);
  if (!shards.empty() || journals.empty()) return std::nullopt;
  double age = std::numeric_limits<double>::infinity();
  for (const fs::path& journal : journals) {
    age = std::min(age, CalcAge(journal));
    if (age < kQuiet || IsLocked(journal)) return std::nullopt;
  }
  return age;
}

/** Adds a line of the text that counts what is finished.
@param since  what does not stay the same while nothing happens. */
void AddStep(const std::string& step, FolderStatus& status, const std::string& since = "") {
  status.steps.push_back(step);
  status.text += step + since + "\n";
}

void AddJudge(const fs::path& folder, const JudgeProgress& judge, FolderStatus& status) {
  std::string step = std::to_string(judge.num_judged) + " of " +
                     FormatCount(judge.num_held, "held grasp") + " judged";
  const bool is_finished = judge.num_judged >= judge.num_held;
  if (!is_finished && FindIdleTime(folder, "judge", judge.shards)) {
    step += std::string(kNobodyWorks) + ": graspbench judge " + QuoteForShell(folder.string()) +
            " goes on with it";
  }
  if (status.is_finished) {
    status.num_done = judge.num_judged;
    status.num_all = judge.num_held;
  }
  status.text += "\n";
  AddStep(step, status);
  status.text += FormatShards(judge.shards, "held grasps");
  status.is_finished &= is_finished;
}

void AddSession(const fs::path& folder, const SessionProgress& progress, FolderStatus& status) {
  status.is_finished = progress.num_finished >= progress.num_trials;
  const std::optional<double> idle =
      status.is_finished ? std::nullopt : FindIdleTime(folder, "journal", progress.shards);
  AddStep(folder.string() + ": " + std::to_string(progress.num_finished) + " of " +
              FormatCount(progress.num_trials, "trial") + " finished" + (idle ? kNobodyWorks : ""),
          status, idle ? ", the last trial ended " + FormatDuration(*idle) + " ago" : "");
  status.text += FormatShards(progress.shards, "trials");
  status.num_done = progress.num_finished;
  status.num_all = progress.num_trials;
  if (progress.judge) AddJudge(folder, *progress.judge, status);
  AddUnchecked(progress.unchecked, status);
  if (progress.num_foreign_lines > 0) {
    AddNote(FormatCount(progress.num_foreign_lines, "record is", "records are") +
                " of trials that are not in the plan; these lines are ignored",
            status);
  }
  AddDamage(folder, progress.damages, progress.num_bad_lines, status);
}

void AddCampaign(const fs::path& folder, const CampaignProgress& progress, FolderStatus& status) {
  AddStep(folder.string() + ": " + std::to_string(progress.num_finished) + " of " +
              FormatCount(progress.num_scenes, "scene") + " finished" +
              (progress.num_searches > 0
                   ? "; " + FormatCount(progress.num_searches, "search", "searches") + " begun"
                   : ""),
          status);
  status.text += FormatShards(progress.shards, "scenes");
  status.num_done = progress.num_finished;
  status.num_all = progress.num_scenes;
  AddUnchecked(progress.unchecked, status);
  AddDamage(folder, progress.damages, 0, status);
  if (progress.benchmark) AddSession(folder / "benchmark", *progress.benchmark, status);
  status.is_finished &= progress.num_finished >= progress.num_scenes;
}

/** @param unit  of what its journal keeps: "evaluation". */
void AddSearch(const fs::path& folder, const SearchProgress& progress, const std::string& unit,
               FolderStatus& status) {
  AddStep(folder.string() + ": " + (progress.is_finished ? "" : "not ") + "finished, " +
              FormatCount(progress.num_answers, unit) + " kept",
          status, progress.age ? ", the last " + FormatFixed(*progress.age, 0) + " s ago" : "");
  status.json = {{"answers", progress.num_answers},
                 {"finished", progress.is_finished},
                 {"age_s", progress.age ? Json(*progress.age) : Json(nullptr)}};
  status.is_finished = progress.is_finished;
  AddDamage(folder, progress.damages, progress.num_bad_lines, status);
}

}  // namespace

FolderStatus ReadFolderStatus(const fs::path& folder, double stale_after, StatusLook look) {
  if (FindStoreKind(folder) == nullptr && fs::exists(folder / "hand.yaml")) {
    const fs::path development = folder / "development";
    if (FindStoreKind(development) == &kDevelopmentStore) {
      return ReadFolderStatus(development, stale_after, look);
    }
    throw Error(ErrorKind::kNotFound,
                "\"" + folder.string() +
                    "\" is a hand (hand.yaml) without a development; expected the folder of a "
                    "session, campaign, optimisation or development. graspbench hand check " +
                    QuoteForShell(folder.string()) + " checks the hand");
  }
  FolderStatus status;
  status.is_checked = look == StatusLook::kVerified ||
                      (look == StatusLook::kQuick && CalcSize(folder) <= kMostChecked);
  const IndexUse index_use = status.is_checked ? IndexUse::kIgnore : IndexUse::kBelieve;
  const StoreKind* kind = FindStoreKind(folder);
  if (kind == &kCampaignStore) {
    const CampaignProgress progress = ReadCampaignProgress(folder, stale_after, index_use);
    status.json = MakeStatusJson(progress);
    AddCampaign(folder, progress, status);
  } else if (kind == &kSceneStore || kind == &kDevelopmentStore || kind == &kJudgedGraspStore ||
             kind == &kRehearsalStore) {
    AddSearch(folder, ReadSearchProgress(folder),
              kind == &kJudgedGraspStore ? "verdict"
              : kind == &kRehearsalStore ? "pair"
                                         : "evaluation",
              status);
  } else {
    const SessionProgress progress = ReadProgress(folder, stale_after, index_use);
    status.json = MakeStatusJson(progress);
    AddSession(folder, progress, status);
  }
  if (status.is_checked) {
    status.damage.clear();  // of counting; it is among these
    AddDamage(folder, FindLastingDamage(folder), 0, status);
    for (const std::string& file : FindUnverified(folder)) {
      AddNote(DescribeUnverified(file), status);
    }
  }
  status.json["checked"] = status.is_checked;
  status.json["damaged"] = !status.damage.empty();
  return status;
}

std::string DescribeUncheckedStatus(const fs::path& folder) {
  return "not verified: graspbench verify " + QuoteForShell(folder.string()) + " checks every byte";
}

}  // namespace graspbench
