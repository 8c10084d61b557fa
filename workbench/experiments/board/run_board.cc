#include "workbench/experiments/board/run_board.h"

#include <memory>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "datasets/journal/sealed_store.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/scratch_folder.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr size_t kNameDigits = 16;  // of a hash in a folder's name

/** @returns what seed and nonce were checked against. */
std::string CheckCommitment(const BoardRequest& request) {
  const Benchmark& benchmark = request.benchmark;
  if (request.commitment.empty() && benchmark.commitment.empty()) {
    throw Error(ErrorKind::kUsage, benchmark.name +
                                       " has no commitment of held-out draws; give the published "
                                       "one with --commitment");
  }
  const std::string commitment =
      request.commitment.empty() ? benchmark.commitment : ReadCommitment(request.commitment);
  if (request.nonce.size() < kShortestNonce) {
    throw Error(ErrorKind::kUsage, "the nonce has " + std::to_string(request.nonce.size()) +
                                       " characters; expected at least " +
                                       std::to_string(kShortestNonce));
  }
  if (*request.held_out_seed == benchmark.session.seed) {
    throw Error(ErrorKind::kUsage, "the held-out seed is that of the public draws");
  }
  const std::string found = CalcCommitment(benchmark.name, *request.held_out_seed, request.nonce);
  if (found == commitment) return commitment;
  throw Error(ErrorKind::kUsage, "seed and nonce are not what was committed to: SHA-256 of \"" +
                                     benchmark.name + " " + std::to_string(*request.held_out_seed) +
                                     " NONCE\" is " + found + ", published was " + commitment);
}

/** Every trial of the entry's session on this seed, simulated here; those of an earlier call are
taken. */
Session SimulateAgain(const Entry& entry, int seed, const fs::path& folder,
                      const BoardRequest& request, Observer& observer) {
  const bool is_held_out = seed != entry.session.config.seed;
  const SessionConfig config =
      is_held_out ? MakeHeldOut(entry.session.config, seed) : entry.session.config;
  const SessionInputs inputs =
      is_held_out ? LoadSessionInputs(config, FieldUse::kLater, entry.session.folder)
                  : entry.inputs;
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  if (!HasSession(folder)) {
    MakeFolder(folder.parent_path());
    StagedFolder staged({folder, "", false, {}});
    if (fs::exists(entry.session.folder / "inputs")) {
      fs::copy(entry.session.folder / "inputs", staged.path() / "inputs",
               fs::copy_options::recursive);
    }
    CopyRehearsed(inputs, staged.path());
    CreateSession(staged.path(), config, plan);
    staged.Commit();
  }
  Session again = LoadSession(folder, OnDamage::kRefuse, RecordParts::kBrief);
  CheckSameSession(again, config, plan);
  const std::vector<PlannedTrial> left = FindUnfinished(again);
  if (left.empty()) return again;
  const auto make_worker = [&](int worker) {
    const auto journal = std::make_shared<JournalWriter>(folder, worker);
    return MakeTrialWorker(
        config, inputs, [journal](const TrialRecord& record) { journal->Append(record); }, nullptr,
        MakeRecordedPolicies(entry.session));
  };
  SealStore(kSessionStore, folder);
  const bool is_complete =
      RunBatch(MakeStage(StageKind::kReplay, left.size()), left, request.num_workers, make_worker,
               observer, request.trial_time_limit);
  SealStore(kSessionStore, folder);
  if (!is_complete) {
    throw Error(ErrorKind::kInterrupted, "stopped; the trials that were simulated are kept in \"" +
                                             request.work.string() +
                                             "\". The same command goes on");
  }
  return LoadSession(folder, OnDamage::kRefuse, RecordParts::kBrief);
}

/** @returns the session with what was found. */
Session Measure(Session session, const BoardRequest& request, Observer& observer) {
  const auto demand = [&](bool is_complete) {
    if (is_complete) return;
    throw Error(ErrorKind::kInterrupted, "stopped; what was found is kept in \"" +
                                             request.work.string() +
                                             "\". The same command goes on");
  };
  if (request.with_judge) {
    demand(JudgeSession(session.folder, request.num_workers, observer, OnDamage::kRefuse,
                        request.trial_time_limit)
               .is_complete);
  }
  if (request.with_thresholds && session.config.policy.command.empty()) {
    ExperimentRequest experiment;
    experiment.folder = session.folder;
    experiment.trial_time_limit = request.trial_time_limit;
    experiment.num_workers = request.num_workers;
    demand(RunExperiment(PrepareThresholds(experiment, kThresholdScales[0]), experiment, observer));
  }
  if (!request.with_judge) return session;
  return LoadSession(session.folder, OnDamage::kRefuse, RecordParts::kBrief);
}

void ReplaceAll(const std::string& from, const std::string& to, std::string& text) {
  for (size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/** Faults without the places of this machine, so that a board is the same elsewhere. */
Entry LoadPacked(const fs::path& pack, const fs::path& folder, const Benchmark& benchmark) {
  try {
    return LoadEntry(pack, folder, benchmark);
  } catch (const Error& fault) {
    std::string text = fault.what();
    ReplaceAll(folder.string() + "/", "", text);
    ReplaceAll(pack.string(), pack.filename().string(), text);
    throw Error(fault.kind(), text);
  }
}

/** @param name  of the entry as soon as it is known. */
BoardEntry CheckOne(const fs::path& pack, const BoardRequest& request, Observer& observer,
                    std::string& name) {
  BoardEntry checked;
  checked.pack = pack.filename().string();
  const ScratchFolder scratch({});
  const Entry entry = LoadPacked(pack, scratch.path() / "entry", request.benchmark);
  name = entry.facts.name;
  checked.facts = entry.facts;
  checked.sha256 =
      SealFile(pack.has_parent_path() ? pack.parent_path() : fs::path("."), checked.pack).sha256;
  const fs::path work = request.work / (checked.sha256.substr(0, kNameDigits) + "-" +
                                        CalcHashHex(FindBuild()).substr(0, kNameDigits / 2));
  Session again =
      SimulateAgain(entry, request.benchmark.session.seed, work / "public", request, observer);
  checked.reproduction = CompareRecords(entry.session, again);
  if (!checked.reproduction.is_within_tolerance()) {
    throw Error(
        ErrorKind::kUsage,
        FormatCountOf(checked.reproduction.num_other_outcome, checked.reproduction.num_trials) +
            " trials end otherwise than recorded when they are simulated again, more than "
            "1 %; first difference, " +
            checked.reproduction.first);
  }
  checked.public_draws = TakeDraws(again);
  const bool is_held_out = request.held_out_seed && entry.session.config.policy.command.empty();
  if (is_held_out) {
    const int seed = *request.held_out_seed;
    again = SimulateAgain(entry, seed, work / ("seed-" + std::to_string(seed)), request, observer);
  }
  again = Measure(std::move(again), request, observer);
  for (ThresholdSummary& summary : LoadThresholds(again)) {
    if (summary.scale == &kThresholdScales[0]) checked.thresholds = std::move(summary);
  }
  if (is_held_out) {
    checked.held_out = TakeDraws(again);
  } else {
    checked.public_draws = TakeDraws(again);
  }
  return checked;
}

}  // namespace

Board RunBoard(const BoardRequest& request, Observer& observer) {
  Board board;
  board.benchmark = request.benchmark;
  board.held_out_seed = request.held_out_seed;
  if (request.held_out_seed) board.commitment = CheckCommitment(request);
  SessionInputs inputs = LoadPinned(request.benchmark);
  if (request.held_out_seed) inputs = LoadHeldOut(request.benchmark, *request.held_out_seed);
  for (const fs::path& pack : request.packs) {
    std::string name;
    try {
      board.entries.push_back(CheckOne(pack, request, observer, name));
    } catch (const Error& fault) {
      const ErrorKind kind = fault.kind();
      const bool is_of_machine = kind == ErrorKind::kIo || kind == ErrorKind::kEnvironment;
      if (is_of_machine || kind == ErrorKind::kInterrupted) throw;
      board.refused.push_back({pack.filename().string(), name, fault.what()});
    }
  }
  RankEntries(inputs, board);
  return board;
}

}  // namespace graspbench
