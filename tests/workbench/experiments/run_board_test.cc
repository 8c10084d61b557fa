#include "workbench/experiments/board/run_board.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "core/base/files/files.h"
#include "core/statistics/summary.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "tests/datasets/benchmark/tiny_benchmark.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/board/make_entry.h"
#include "workbench/experiments/run_session.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

constexpr char kNonce[] = "a nonce of letters";

/** Two sessions of the tiny benchmark, run once for all tests, as packs "g1.tar" and "best.tar". */
class RunBoardTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = new TemporaryFolder;
    tiny_ = new Benchmark(MakeTinyBenchmark());
    for (const char* grasp : {"best", "g1"}) {
      SessionRequest request;
      request.config = tiny_->session;
      request.config->grasps = {grasp};
      request.out = Made(grasp);
      Observer observer;
      RunRound(kTrialRound, PrepareSession(request), 1, observer);
      MakeEntry({request.out, *tiny_, MakeFacts(grasp), Made(grasp + std::string(".tar"))});
    }
  }
  static void TearDownTestSuite() {
    delete made_;
    delete tiny_;
  }
  static fs::path Made(const std::string& name) { return made_->path() / name; }
  static EntryFacts MakeFacts(const std::string& name) {
    return {name, "A. Person", "CC0-1.0", "2026-11-28", "As shipped.", {}, {}};
  }

  Board Run(const std::vector<fs::path>& packs) {
    request_.benchmark = *tiny_;
    request_.packs = packs;
    request_.work = top_ / "work";
    Observer observer;
    return RunBoard(request_, observer);
  }
  /** A pack whose journal somebody has changed, with all its hashes made again. */
  fs::path Rewrite(const std::string& name, const std::function<void(TrialRecord&)>& change) {
    const fs::path folder = top_ / ("of-" + name), session = folder / "session";
    Unpack(Made("best.tar"), folder, kEntryPack);
    std::string lines;
    for (TrialRecord record : LoadSession(session).records) {
      change(record);
      lines += FormatJournalLine(record) + "\n";
    }
    WriteFile(session / "journal" / "0.jsonl", lines);
    fs::remove(session / "manifest.json");
    SealStore(kSessionStore, session);
    fs::remove(folder / "manifest.json");
    SealPack(folder, kEntryPack, {"graspbench entry SESSION", {}, {}});
    WritePack(folder, top_ / (name + ".tar"));
    return top_ / (name + ".tar");
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path();
  BoardRequest request_;
  static TemporaryFolder* made_;
  static Benchmark* tiny_;
};
TemporaryFolder* RunBoardTest::made_ = nullptr;
Benchmark* RunBoardTest::tiny_ = nullptr;

TEST_F(RunBoardTest, EntriesAreSimulatedAgainOnce) {
  const Board board = Run({Made("best.tar"), Made("g1.tar")});
  ASSERT_EQ(board.entries.size(), 2u);
  EXPECT_TRUE(board.refused.empty());
  for (const BoardEntry& entry : board.entries) {
    EXPECT_EQ(entry.reproduction.num_identical, 4) << entry.reproduction.first;
    EXPECT_EQ(entry.public_draws.trials.size(), 4u);
  }
  std::map<std::string, fs::file_time_type> times;
  for (const auto& file : fs::recursive_directory_iterator(top_ / "work")) {
    if (file.path().extension() == ".jsonl") times[file.path()] = file.last_write_time();
  }
  EXPECT_EQ(times.size(), 4u);  // plan and journal of both
  EXPECT_EQ(Run({Made("best.tar"), Made("g1.tar")}).entries.size(), 2u);
  for (const auto& [path, time] : times) EXPECT_EQ(fs::last_write_time(path), time) << path;
}

TEST_F(RunBoardTest, ARecordThatWasEditedIsFoundByItsTrial) {
  const fs::path pack = Rewrite("edited", [](TrialRecord& record) {
    if (record.plan.trial == 1) record.result.lift_height += 1e-9;
  });
  const Board board = Run({pack});
  ASSERT_EQ(board.entries.size(), 1u);
  EXPECT_EQ(board.entries[0].reproduction.num_identical, 2);
  EXPECT_EQ(board.entries[0].reproduction.num_other_outcome, 0);
  EXPECT_TRUE(Has(board.entries[0].reproduction.first, "lift_height"));
}

TEST_F(RunBoardTest, AnOutcomeThatWasEditedCostsTheRank) {
  const fs::path pack = Rewrite("edited", [](TrialRecord& record) {
    const bool was = IsSuccess(record.result.outcome);
    record.result.outcome = was ? Outcome::kNoContact : Outcome::kSuccess;
  });
  const Board board = Run({pack});
  EXPECT_TRUE(board.entries.empty());
  ASSERT_EQ(board.refused.size(), 1u);
  EXPECT_EQ(board.refused[0].name, "best");
  EXPECT_TRUE(Has(board.refused[0].reason, "4 trials end otherwise than recorded"));
}

// Under its own trials' ids: the results of another grasp.
TEST_F(RunBoardTest, RecordsOfAnotherEntryAreFoundByTheTrials) {
  const Session other = LoadSession(Made("g1"));
  size_t next = 0;
  const fs::path pack = Rewrite(
      "borrowed", [&](TrialRecord& record) { record.result = other.records[next++].result; });
  const Board board = Run({pack});
  if (board.refused.empty()) {
    EXPECT_EQ(board.entries[0].reproduction.num_identical, 0);
  } else {
    EXPECT_TRUE(Has(board.refused[0].reason, "end otherwise than recorded"));
  }
}

TEST_F(RunBoardTest, AnEntryUnderAnotherNameHasNoRank) {
  MakeEntry({Made("best"), *tiny_, MakeFacts("copy"), top_ / "copy.tar"});
  const Board board = Run({Made("best.tar"), top_ / "copy.tar"});
  ASSERT_EQ(board.refused.size(), 1u);
  EXPECT_EQ(board.refused[0].name, "copy");
  EXPECT_TRUE(Has(board.refused[0].reason, "same results in every trial as \"best\""));
}

TEST_F(RunBoardTest, ReasonsNameNoPlaceOfThisMachine) {
  WriteFile(top_ / "bad.tar", ReadFile(Made("best.tar")).substr(0, 3000));
  fs::path seed = Rewrite("seed", [](TrialRecord& record) { record.plan.trial += 100; });
  const Board board = Run({top_ / "bad.tar", seed});
  ASSERT_EQ(board.refused.size(), 2u);
  for (const RefusedEntry& one : board.refused) {
    EXPECT_EQ(one.reason.find(top_.string()), one.reason.npos) << one.reason;
    EXPECT_EQ(one.reason.find(fs::temp_directory_path().string() + "/"), one.reason.npos)
        << one.reason;
  }
}

TEST_F(RunBoardTest, HeldOutDrawsNeedWhatWasCommittedTo) {
  request_.held_out_seed = 7;
  request_.nonce = kNonce;
  const auto run = [&] { Run({Made("best.tar")}); };
  EXPECT_TRUE(Throws(run, ErrorKind::kUsage, "has no commitment"));
  request_.commitment = CalcCommitment("tiny/1", 8, kNonce);
  EXPECT_TRUE(Throws(run, ErrorKind::kUsage, "are not what was committed to"));
  request_.nonce = "short";
  EXPECT_TRUE(Throws(run, ErrorKind::kUsage, "the nonce has 5 characters"));
  request_.nonce = kNonce;
  request_.held_out_seed = 1;
  EXPECT_TRUE(Throws(run, ErrorKind::kUsage, "that of the public draws"));
  request_.held_out_seed = 7;
  request_.commitment = "00";
  EXPECT_TRUE(Throws(run, ErrorKind::kUsage, "expected 64 hexadecimal digits"));
  request_.commitment = CalcCommitment("tiny/1", 7, kNonce);
  const Board board = Run({Made("best.tar")});
  ASSERT_EQ(board.entries.size(), 1u);
  ASSERT_TRUE(board.entries[0].held_out);
  EXPECT_EQ(board.entries[0].held_out->config.seed, 7);
  EXPECT_EQ(board.lines[0].tally.finished, 4);
  EXPECT_TRUE(board.lines[0].gap);
}

// The same judge and the same bisection as of the entry's own session.
TEST_F(RunBoardTest, BreakingLoadsAndThresholdsAreFoundWhereTheyAreAskedFor) {
  EXPECT_TRUE(Run({Made("best.tar")}).lines[0].thresholds.empty());
  request_.with_judge = request_.with_thresholds = true;
  const Board board = Run({Made("best.tar")});
  ASSERT_EQ(board.lines.size(), 1u);
  const BoardLine& line = board.lines[0];
  EXPECT_EQ(line.thresholds.size(), 4u);
  Observer observer;
  JudgeSession(Made("best"), 1, observer);
  std::vector<double> forces;
  for (const TrialRecord& record : LoadSession(Made("best")).records) {
    if (record.judgement) forces.push_back(record.judgement->breaking_force);
  }
  EXPECT_EQ(size_t(line.breaking_force.n), forces.size());
  EXPECT_EQ(line.breaking_force.median, CalcMedian(forces));
  ExperimentRequest request;
  request.folder = Made("best");
  const PreparedSession grips = PrepareThresholds(request, kThresholdScales[0]);
  RunExperiment(grips, request, observer);
  const ThresholdSummary summary = LoadThresholds(LoadSession(Made("best"))).front();
  for (size_t i = 0; i < summary.draws.size(); ++i) {
    EXPECT_EQ(line.thresholds[i], summary.draws[i].value);
  }
  // What was found stays in the folder of work.
  request_.with_judge = request_.with_thresholds = false;
  EXPECT_EQ(Run({Made("best.tar")}).lines[0].thresholds, line.thresholds);
}

// A benchmark of two synthetic objects of seed 1: those of the held-out draws are others, whose
// rehearsed grasps the board makes.
TEST_F(RunBoardTest, HeldOutDrawsOfUnseenObjectsAreGraspedAnew) {
  std::string text = MakeTinyText();
  text = text.substr(0, text.find("objects:")) + "objects:\n";
  for (const char* id : {"synthetic_1_g1_0", "synthetic_1_g6_0"}) {
    text +=
        std::string("  ") + id + ": \"" + LoadObject(id, FieldUse::kLater)->content_hash + "\"\n";
  }
  const Benchmark unseen = ParseBenchmark(text, "unseen.yaml");
  SessionRequest request;
  request.config = unseen.session;
  request.config->grasps = {"rehearsed-4-2"};
  request.out = top_ / "unseen";
  Observer observer;
  RunRound(kTrialRound, PrepareSession(request), 1, observer);
  const fs::path pack = top_ / "unseen.tar";
  MakeEntry({request.out, unseen, MakeFacts("unseen"), pack});
  request_.held_out_seed = 7;
  request_.nonce = kNonce;
  request_.commitment = CalcCommitment("tiny/1", 7, kNonce);
  request_.benchmark = unseen;
  request_.packs = {pack};
  request_.work = top_ / "work";
  const Board board = RunBoard(request_, observer);
  ASSERT_TRUE(board.refused.empty()) << board.refused[0].reason;
  EXPECT_EQ(board.objects, (std::vector<std::string>{"synthetic_7_g1_0", "synthetic_7_g6_0"}));
  EXPECT_EQ(board.lines[0].objects.size(), 2u);
  EXPECT_EQ(board.lines[0].objects.at("synthetic_7_g6_0").finished, 2);
  EXPECT_EQ(board.lines[0].tally.finished, 4);
  EXPECT_TRUE(board.lines[0].gap);
  EXPECT_EQ(RunBoard(request_, observer).lines.size(), 1u);  // from what is kept
}

TEST_F(RunBoardTest, SessionsThatAreNotTheBenchmarksAreNoEntries) {
  Benchmark other = *tiny_;
  other.session.seed = 2;
  EXPECT_TRUE(Throws(
      [&] {
        MakeEntry({Made("best"), other, MakeFacts("x"), top_ / "x.tar"});
      },
      ErrorKind::kUsage, "seed: 2 and 1"));
  EXPECT_FALSE(fs::exists(top_ / "x.tar"));
  EXPECT_TRUE(Throws(
      [&] {
        MakeEntry({Made("best"), *tiny_, MakeFacts("x"), Made("g1.tar")});
      },
      ErrorKind::kUsage, "already there"));
}

}  // namespace
}  // namespace graspbench
