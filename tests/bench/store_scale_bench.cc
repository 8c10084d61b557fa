// A session of a million made-up records, in two folders as two machines leave it: what merging,
// opening, indexing and asking the index take, each in a process of its own.
//   store_scale_bench FOLDER [RECORDS]
// FOLDER must not be there; a million records take some 6 GB in it, and it stays for runs by hand.
// Wanted: index asked in 2 s, merged in 60 s, with less than 500 MB.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include "core/base/files/files.h"
#include "datasets/session/merge_sessions.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Of 20 objects: a cell may have 100,000 trials. */
std::vector<PlannedTrial> CreateLargeSession(const fs::path& folder, int num_records) {
  SessionInputs inputs = MakeFakeInputs();
  while (inputs.objects.size() < 20) {
    inputs.objects.push_back(MakeFakeObject("object_" + std::to_string(inputs.objects.size())));
  }
  SessionConfig config;
  config.trials = num_records / static_cast<int>(inputs.hands.size() * inputs.objects.size());
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  CreateSession(folder, config, plan);
  return plan;
}

/** Every second trial each, in the journals of two shards; a file of few system calls. */
void WriteRecords(const fs::path& folder, const std::vector<PlannedTrial>& plan, size_t first) {
  const std::string label = std::to_string(first + 1) + "of2";
  AppendFile journal(FindJournal(folder / "journal", 0, label));
  std::string lines;
  for (size_t i = first; i < plan.size(); i += 2) {
    lines += FormatJournalLine(MakeFakeRecord(plan[i])) + "\n";
    if (lines.size() < (1 << 24) && i + 2 < plan.size()) continue;
    journal.Append(lines);
    lines.clear();
  }
}

/** Runs it in another process. */
void Measure(const char* what, const std::function<std::string()>& work) {
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      std::printf("%-28s %s", what, work().c_str());
      std::fflush(stdout);
      ::_exit(0);
    } catch (const std::exception& fault) {
      std::printf("%-28s FAILED: %s\n", what, fault.what());
      std::fflush(stdout);
      ::_exit(1);
    }
  }
  int status = 0;
  struct rusage usage {};
  ::wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const double processor =
      static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
      1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  if (status == 0) {
    std::printf("; %.2f s, %.2f s of a processor, %ld MB\n", time.count(), processor,
                usage.ru_maxrss / 1024);
  }
}

/** The first column of the first row. */
long Ask(sqlite3* db, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  long answer = -1;
  if (sqlite3_prepare_v2(db, sql, -1, &statement, nullptr) == SQLITE_OK &&
      sqlite3_step(statement) == SQLITE_ROW) {
    answer = static_cast<long>(sqlite3_column_int64(statement, 0));
    while (sqlite3_step(statement) == SQLITE_ROW) {
    }
  }
  sqlite3_finalize(statement);
  return answer;
}

std::string AskIndex(const fs::path& index, size_t num_records) {
  sqlite3* db = nullptr;
  if (sqlite3_open_v2(index.c_str(), &db, SQLITE_OPEN_READONLY, nullptr) != SQLITE_OK) {
    throw Error(ErrorKind::kIo, "no index");
  }
  const long finished = Ask(db, "SELECT sum(finished) FROM cells");
  const long failed = Ask(db, "SELECT count(*) FROM trials WHERE hand = 'tum' AND success = 0");
  Ask(db,
      "SELECT hand, object, grasp, count(*), avg(success), avg(gft_ratio), avg(sigma) FROM trials "
      "GROUP BY hand, object, grasp");
  sqlite3_close(db);
  if (finished != static_cast<long>(num_records) || failed <= 0) {
    throw Error(ErrorKind::kFormat, "the index does not hold the records");
  }
  return std::to_string(failed) + " failures of a hand";
}

int Run(const fs::path& folder, int num_records) {
  if (fs::exists(folder)) throw Error(ErrorKind::kUsage, folder.string() + " is there already");
  MakeFolder(folder);
  const fs::path a = folder / "a", b = folder / "b";
  const auto num_planned = static_cast<size_t>(num_records / 40 * 40);  // as many to each cell
  Measure("records made", [&] {
    const auto plan = CreateLargeSession(a, num_records);
    fs::copy(a, b, fs::copy_options::recursive);
    WriteRecords(a, plan, 0);
    WriteRecords(b, plan, 1);
    return std::to_string(plan.size()) + " records";
  });
  Measure("merge of two halves",
          [&] { return std::to_string(MergeSessions(a, {b})) + " records new"; });
  Measure("opened", [&] {
    const size_t count = LoadSession(a, OnDamage::kRefuse, RecordParts::kBrief).records.size();
    if (count != num_planned) throw Error(ErrorKind::kFormat, std::to_string(count) + " records");
    return std::to_string(count) + " records";
  });
  Measure("opened, index and tables", [&] {
    ExportSession(a, LoadSession(a, OnDamage::kRefuse, RecordParts::kBrief));
    return std::to_string(fs::file_size(a / "index.sqlite") >> 20) + " MB of index";
  });
  Measure("index asked", [&] { return AskIndex(a / "index.sqlite", num_planned); });
  return 0;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "store_scale_bench FOLDER [RECORDS]\n");
    return 2;
  }
  try {
    return graspbench::Run(argv[1], argc > 2 ? std::stoi(argv[2]) : 1000000);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
}
