#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "datasets/campaign/check_records.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/journal/unverified_files.h"
#include "tests/datasets/journal/store_mutations.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/folder_status.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** What `graspbench verify` gives 3 for. */
bool IsRefused(const fs::path& folder) {
  try {
    StoreState state = CheckStore(folder);
    CheckRecords(folder, state);
    return !state.damages.empty();
  } catch (const Error&) {
    return true;
  }
}

/** What `graspbench status` gives 0 for. */
bool IsContent(const fs::path& folder) {
  try {
    const FolderStatus status = ReadFolderStatus(folder, 60.0);
    return status.is_checked && status.damage.empty();
  } catch (const Error&) {
    return false;
  }
}

/** Files of which `verify` cannot tell, by their names from the folder of all stores. */
std::set<std::string> ListUnverified(const fs::path& folder, const std::string& store) {
  std::set<std::string> names;
  for (const std::string& name : FindUnverified(folder / store)) {
    names.insert(store + "/" + name);
  }
  return names;
}

/** The store's own files but the journals and the record of the run, and the different records.
@param untold  what nobody vouches for, and says so. */
std::pair<Files, std::set<std::string>> ListKnown(const Files& files, const std::string& store,
                                                  const std::set<std::string>& untold) {
  Files own, others;
  for (const auto& [name, content] : files) {
    if (name.rfind(store + "/", 0) != 0) continue;
    own[name] = content;
    const bool is_plan = name.find("plan.jsonl") != name.npos;
    const bool is_journal = name.find(".jsonl") != name.npos && !is_plan;
    if (is_journal || untold.count(name) > 0 || name.find("/run.json") != name.npos) continue;
    others[name] = content;
  }
  const std::multiset<std::string> records = ListRecords(own);
  return {others, std::set<std::string>(records.begin(), records.end())};
}

TEST(FolderStatusSlow, IsContentOnlyWithWhatVerifyDoesNotRefuse) {
  constexpr int kNumDamages = 1000;
  const TemporaryFolder folder;
  const std::vector<std::string> stores = {"session", "other", "scene", "campaign"};
  MakeStores(folder.path());
  const Files whole = ReadFiles(folder.path());
  for (const std::string& store : stores) {
    EXPECT_TRUE(IsContent(folder.path() / store)) << store;
    EXPECT_TRUE(ListUnverified(folder.path(), store).empty()) << store;
  }
  Mutator mutator(whole, "status", kNumMutations);
  int num_refused = 0, num_by_status = 0, num_believed = 0, num_lost = 0;
  for (int done = 0; done < kNumDamages;) {
    Files files;
    const std::string what = mutator.Mutate(files);
    if (files == whole) continue;
    ++done;
    WriteFiles(folder.path(), files);
    for (const std::string& store : stores) {
      if (what.find(store + "/") == what.npos) continue;
      const bool is_refused = IsRefused(folder.path() / store);
      const bool is_content = IsContent(folder.path() / store);
      num_refused += is_refused;
      num_by_status += !is_refused && !is_content;
      EXPECT_FALSE(is_refused && is_content) << "status is content: " << what;
      if (!is_refused) {
        const std::set<std::string> untold = ListUnverified(folder.path(), store);
        if (ListKnown(whole, store, untold) != ListKnown(files, store, untold)) {
          ++num_believed;
          ADD_FAILURE() << "believed: " << what;
        }
      }
      try {
        RepairStore(folder.path() / store);
      } catch (const Error&) {  // beyond repair, and said so
      }
    }
    const auto before = ListRecords(files), after = ListRecords(ReadFiles(folder.path()));
    if (!std::includes(after.begin(), after.end(), before.begin(), before.end())) {
      ++num_lost;
      ADD_FAILURE() << "lost records: " << what;
    }
    WriteFiles(folder.path(), whole);
  }
  std::printf(
      "%d damages: %d stores refused, %d by status alone, %d believed, %d with lost records\n",
      kNumDamages, num_refused, num_by_status, num_believed, num_lost);
}

}  // namespace
}  // namespace graspbench
