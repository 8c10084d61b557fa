// A board of 200 entries of graspbench-21/1 whose simulations are kept: what checking, comparing,
// ranking and the page take.
//   board_scale_bench FOLDER [ENTRIES]
// FOLDER must not be there. Results are synthetic, of both hands. Wanted: 60 s, 200 MB.
#include <sys/resource.h>

#include <cstdio>
#include <ctime>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "reports/board_page.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/board/run_board.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** A pack and, where the board will look for it, the session that simulating it again has given. */
fs::path MakeKeptEntry(const Benchmark& benchmark, const SessionInputs& inputs, int number,
                       const fs::path& folder) {
  const std::string name = "entry " + std::to_string(number);
  SessionConfig config = benchmark.session;
  config.strategy.grip_margin = 2.0 + 1e-3 * number;  // ids of its own
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  const fs::path session = folder / "session", entry = folder / "entry";
  MakeFolder(session);
  CopyRehearsed(inputs, session);
  CreateSession(session, config, plan);
  std::string lines;
  for (const PlannedTrial& planned : plan) {
    lines += FormatJournalLine(MakeFakeRecord(planned)) + "\n";
  }
  MakeFolder(session / "journal");
  WriteFile(session / "journal" / "0.jsonl", lines);
  SealStore(kSessionStore, session);
  GatherEntry(
      LoadSession(session, OnDamage::kRefuse, RecordParts::kBrief),
      {name, "A. Person", "CC0-1.0", "2026-11-28", "Made up.", benchmark.name, benchmark.sha256},
      entry);
  const fs::path pack = folder / "packs" / (name + ".tar");
  MakeFolder(pack.parent_path());
  WritePack(entry, pack);
  const fs::path work = folder / "work" /
                        (SealFile(pack.parent_path(), name + ".tar").sha256.substr(0, 16) + "-" +
                         CalcHashHex(FindBuild()).substr(0, 8));
  MakeFolder(work);
  fs::rename(session, work / "public");
  fs::remove_all(entry);
  return pack;
}

int Run(const fs::path& folder, int num_entries) {
  if (fs::exists(folder)) throw Error(ErrorKind::kUsage, folder.string() + " is there already");
  BoardRequest request;
  request.benchmark = LoadBenchmark(kDefaultBenchmark);
  request.work = folder / "work";
  const SessionInputs inputs = LoadSessionInputs(request.benchmark.session, FieldUse::kLater);
  for (int i = 0; i < num_entries; ++i) {
    request.packs.push_back(MakeKeptEntry(request.benchmark, inputs, i, folder));
  }
  const std::clock_t start = std::clock();
  Observer observer;
  const Board board = RunBoard(request, observer);
  const double ranked = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const std::string page = MakeBoardPage(board);
  WriteFile(folder / "index.html", page);
  const double all = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "%zu entries, %zu lines, %zu refused: ranked %.1f s, with page %.1f s of a processor, "
      "%ld MB; page %.1f MB\n",
      board.entries.size(), board.lines.size(), board.refused.size(), ranked, all,
      usage.ru_maxrss / 1024, static_cast<double>(page.size()) * 1e-6);
  return static_cast<int>(board.entries.size()) == num_entries ? 0 : 1;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  try {
    return graspbench::Run(argv[1], argc > 2 ? std::stoi(argv[2]) : 200);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
}
