/** @file
Random damage to stores of every kind, each followed by the real program: `status` gives 0 only where
`verify` does not give 3, no reader goes on with what `verify` refuses or crashes, what nobody finds
has changed no result, and a repair loses no whole record. */

#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "datasets/campaign/campaign_store.h"
#include "datasets/journal/store_kind.h"
#include "datasets/scene/development_store.h"
#include "tests/datasets/journal/store_mutations.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

constexpr unsigned kLongest = 120;  // [s]; a program that takes longer hangs

void MakeDevelopment(const fs::path& folder) {
  MakeFolder(folder);
  CreateDevelopment(folder, DevelopmentConfig());
  {
    DevelopmentJournal journal(folder / "journal.jsonl");
    for (int request = 0; request < 5; ++request) {
      journal.Append(
          {{request, "search", "0123456789abcdef", {{Outcome::kSuccess, 0.1 * request}}}});
    }
  }
  WriteFile(folder / "result.json", "{\"hand\":\"tum\"}\n");
  SealStore(kDevelopmentStore, folder);
}

/** The program's exit code, a signal with a minus; what it prints goes to the file. */
int Call(std::vector<std::string> arguments, const fs::path& out = "/dev/null") {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(kLongest);  // the program keeps it and ends by a signal
    std::freopen(out.c_str(), "w", stdout);
    std::freopen("/dev/null", "w", stderr);
    arguments.insert(arguments.begin(), GRASPBENCH_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  return WaitFor(child);
}

/** Whether a printed status tells of work that is left ("1 of 2 held grasps judged"): a watch waits
for it. */
bool NamesWorkLeft(const std::string& status) {
  static const std::regex pattern("(\\d+) of (\\d+) (trials?|held grasps?) ");
  for (std::sregex_iterator at(status.begin(), status.end(), pattern), end; at != end; ++at) {
    if ((*at)[1] != (*at)[2]) return true;
  }
  return false;
}

bool IsCrash(int code) { return code < 0 || code == 127; }

/** A folder of the material, with its name from there, by a file in it. */
std::string FindStoreOf(const std::string& file, const std::vector<std::string>& stores) {
  for (const std::string& store : stores) {
    if (file.rfind(store + "/", 0) == 0) return store;
  }
  return "";
}

bool IsIn(const std::string& file, const std::vector<std::string>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return file.find("/" + part) != file.npos; });
}

Files FilesOf(const Files& files, const std::string& store) {
  Files own;
  for (const auto& [name, content] : files) {
    if (name.rfind(store + "/", 0) == 0) own[name] = content;
  }
  return own;
}

/** What a reader may know of a store: its files but the journals and the record of the run, and the
different records in its journals. */
std::pair<Files, std::set<std::string>> ListContent(const Files& files, const std::string& store) {
  const Files own = FilesOf(files, store);
  Files others;
  const std::multiset<std::string> records = ListRecords(own);
  for (const auto& [name, content] : own) {
    const bool is_journal = name.find(".jsonl") != name.npos && !IsIn(name, {"plan.jsonl"});
    if (!is_journal && !IsIn(name, {"run.json"})) others[name] = content;
  }
  return {others, std::set<std::string>(records.begin(), records.end())};
}

/** Parts of the damages, each of a seed of its own. */
class GRASPBENCH_SUITE : public testing::TestWithParam<int> {
 protected:
  GRASPBENCH_SUITE()
      : folder_(fs::path(testing::TempDir()) / ("damaged_stores_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    MakeStores(folder_);
    MakeDevelopment(folder_ / "development");
    const std::string session = folder_ / "real-session", campaign = folder_ / "real-campaign";
    const auto run = [](std::vector<std::string> command, const std::string& out) {
      command.insert(command.end(),
                     {"--hand", "tum", "--object", "golf_ball", "--trials", "1", "--out", out});
      EXPECT_EQ(Call(command), 0) << command[0];
    };
    run({"run"}, session);
    run({"campaign", "--evaluations", "8", "--fitness-trials", "1"}, campaign);
    EXPECT_EQ(Call({"judge", session}), 0);
    EXPECT_EQ(Call({"export", session, "--records"}), 0);
    EXPECT_EQ(Call({"report", session}), 0);
    EXPECT_EQ(Call({"report", campaign}), 0);
    for (const auto& store : fs::directory_iterator(folder_)) {
      stores_.push_back(store.path().filename().string());
    }
    std::sort(stores_.begin(), stores_.end());
  }
  ~GRASPBENCH_SUITE() override {
    if (!HasFailure()) fs::remove_all(folder_);
    fs::remove(folder_.string() + "_told");
  }

  /** Commands that read the store.
  @param is_unfinished  a watch of it would wait for the rest. */
  std::vector<std::vector<std::string>> ListReaders(const std::string& store,
                                                    bool is_unfinished) const {
    const fs::path folder = folder_ / store, out = folder_ / ".out";
    const StoreKind* kind = FindStoreKind(folder);
    if (kind == &kCampaignStore) return {{"report", folder}, {"status", folder, "--json"}};
    if (kind == &kSceneStore || kind == &kDevelopmentStore) return {{"status", folder, "--json"}};
    if (kind != &kSessionStore) return {};
    std::vector<std::vector<std::string>> readers = {
        {"report", folder}, {"export", folder}, {"compare", folder, folder, "--out", out},
        {"best", folder},   {"merge", folder},  {"trial", folder, "--json"}};
    if (store.rfind("real-", 0) != 0) return readers;  // a judge would begin to work
    readers.push_back({"judge", folder});
    if (!is_unfinished) readers.push_back({"watch", folder, "--interval", "0.05"});
    return readers;
  }

  void Damage(int count) {
    const Files whole = ReadFiles(folder_);
    for (const std::string& store : stores_) {
      EXPECT_EQ(Call({"verify", folder_ / store}), 0) << store;
      if (store == "study") continue;
      EXPECT_EQ(Call({"status", folder_ / store}), 0) << store;
    }
    const std::string seed = "damaged stores " + std::to_string(GetParam());
    Mutator mutator(whole, seed, kNumMutations);
    for (int done = 0; done < count;) {
      Files files;
      const std::string what = mutator.Mutate(files);
      if (files == whole) continue;
      ++done;
      std::set<std::string> damaged;
      const auto differs = [](const Files& a, const Files& b, const std::string& name) {
        const auto there = b.find(name);
        return there == b.end() || there->second != a.at(name);
      };
      for (const auto& [name, content] : whole) {
        if (differs(whole, files, name)) damaged.insert(FindStoreOf(name, stores_));
      }
      for (const auto& [name, content] : files) {
        if (differs(files, whole, name)) damaged.insert(FindStoreOf(name, stores_));
      }
      WriteFiles(folder_, files);
      for (const std::string& store : damaged) Check(store, what, whole, files);
      const Files now = ReadFiles(folder_);
      for (const std::string& store : stores_) {
        const Files own = FilesOf(files, store), own_now = FilesOf(now, store);
        if (own == own_now) continue;
        EXPECT_TRUE(damaged.count(store) > 0) << store << " is touched: " << what;
        const auto before = ListRecords(own), after = ListRecords(own_now);
        EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()))
            << "lost records: " << what;
      }
      fs::remove_all(folder_ / ".out");
      WriteFiles(folder_, whole);
      if (HasFailure() && ++num_failures_ > 20) return;
    }
    std::printf("%d damages, %d found by verify, %d by status alone, %d readers called\n", count,
                num_found_, num_by_status_, num_readers_);
  }

 private:
  void Check(const std::string& store, const std::string& what, const Files& whole,
             const Files& files) {
    const fs::path folder = folder_ / store;
    const fs::path told = folder_.string() + "_told";
    const int verify = Call({"verify", folder}, told);
    // Whole, but for tables whose own hashes are gone: said of each.
    const bool is_told = ReadFile(told).find("cannot be verified") != std::string::npos;
    const int status = Call({"status", folder}, told);
    const bool is_unfinished = NamesWorkLeft(ReadFile(told));
    EXPECT_FALSE(IsCrash(verify)) << "verify " << verify << ": " << what;
    EXPECT_FALSE(IsCrash(status)) << "status " << status << ": " << what;
    num_found_ += verify == 3;
    num_by_status_ += verify == 0 && status != 0 && store != "study";
    EXPECT_FALSE(verify == 3 && status == 0) << "status is content: " << what;
    // Only a search itself can tell whose answer it is, by the trials that it asks for.
    const bool is_answer = what.rfind("copy line", 0) == 0 && IsIn(what, {"comparison/"});
    if (verify == 0 && !is_answer && !is_told) {
      EXPECT_EQ(ListContent(whole, store), ListContent(files, store)) << "undetected: " << what;
    }
    for (const std::vector<std::string>& reader : ListReaders(store, is_unfinished)) {
      const int code = Call(reader);
      ++num_readers_;
      EXPECT_FALSE(IsCrash(code)) << reader[0] << " " << code << ": " << what;
      // Tables and pages are read by nobody, and nobody needs the index of records.
      if (verify == 3 && !IsIn(what, {"export/", "report/", "index.sqlite"})) {
        EXPECT_NE(code, 0) << reader[0] << " is content: " << what;
      }
    }
    EXPECT_FALSE(IsCrash(Call({"verify", folder, "--repair"}))) << "repair: " << what;
  }

  fs::path folder_;
  std::vector<std::string> stores_;
  int num_found_ = 0, num_by_status_ = 0, num_readers_ = 0, num_failures_ = 0;
};

TEST_P(GRASPBENCH_SUITE, AreReadByNobodyAndLoseNoRecord) {
  Damage(GRASPBENCH_NUM_FLIPS / GRASPBENCH_NUM_PARTS);
}

INSTANTIATE_TEST_SUITE_P(Parts, GRASPBENCH_SUITE, testing::Range(0, GRASPBENCH_NUM_PARTS));

}  // namespace
}  // namespace graspbench
