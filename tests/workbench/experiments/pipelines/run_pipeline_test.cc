#include "workbench/experiments/pipelines/run_pipeline.h"

#include <chrono>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "tests/workbench/experiments/pipeline_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

using Names = std::set<std::string>;

/** GRASPBENCH_NUM_CHANGES=20 in the environment asks for more than the six of every run. */
int NumChanges() {
  const char* asked = std::getenv("GRASPBENCH_NUM_CHANGES");
  return asked ? std::stoi(asked) : 6;
}

class RunPipelineTest : public PipelineFolder {
 protected:
  void WritePipeline() const {
    WriteFile(top_ / "s.yaml", "hands: [tum]\nobjects: [golf_ball]\ntrials: 1\n" + comment_);
    WriteFile(top_ / "contacts.json",
              "{\"contacts\": [{\"p_m\": [0.03, 0, 0], \"n\": [-1, 0, 0], \"mu\": 0.5},"
              "{\"p_m\": [-0.03, 0, 0], \"n\": [1, 0, 0], \"mu\": 0.5}],"
              "\"torque_scale_m\": 0.05}" +
                  blanks_);
    WriteFile(top_ / "p.yaml",
              "stages:\n"
              "  bench: {command: run, inputs: {session: s.yaml}}\n"
              "  other: {command: run, parameters: {hand: tum, object: golf_ball, trials: 1, set: "
              "model.mass_scale=1." +
                  std::to_string(mass_) +
                  "}}\n"
                  "  tables: {command: export, inputs: {folder: bench}, parameters: {records: " +
                  std::string(has_records_ ? "true" : "false") +
                  "}}\n"
                  "  again: {command: export, inputs: {folder: tables}}\n"
                  "  change: {command: compare, inputs: {before: again, after: other}}\n"
                  "  hull: {command: quality, inputs: {contacts: contacts.json}}\n");
  }
  /** The stages that status calls stale. */
  Names FindStale() const {
    Run("\"$GB\" pipeline status p.yaml --out out --json");
    Names stale;
    const Json json = Json::parse(Log());
    for (const Json& stage : json["stages"]) {
      if (stage["state"] == "stale") stale.insert(stage["stage"].get<std::string>());
    }
    return stale;
  }
  /** Runs what is stale. @returns the stages that ran. */
  Names RunStale() const {
    EXPECT_EQ(Run("\"$GB\" pipeline run p.yaml --out out --jobs 2"), 0) << Log();
    Names run;
    std::ifstream lines(top_ / "log");
    for (std::string line; std::getline(lines, line);) {
      const size_t done = line.find(": done, ");
      if (done != line.npos) run.insert(line.substr(0, done));
    }
    return run;
  }
  /** All stages behind one, by the pipeline above as a person reads it. */
  static Names FindBehind(const std::string& stage) {
    static const std::map<std::string, Names> behind = {
        {"bench", {"bench", "tables", "again", "change"}},
        {"tables", {"tables", "again", "change"}},
        {"other", {"other", "change"}},
        {"hull", {"hull"}}};
    return behind.at(stage);
  }

  std::string comment_, blanks_;
  int mass_ = 1;
  bool has_records_ = true;
};

std::string PickFile(const fs::path& folder, std::mt19937& random) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    // What may vary is no part of the result; a journal counts by its lines, so that one more torn
    // line changes nothing.
    if (!entry.is_regular_file() || name == "run.json" || name == "manifest.json" ||
        name.find("jsonl") != name.npos) {
      continue;
    }
    files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files.at(random() % files.size());
}

TEST_F(RunPipelineTest, OfRandomChangesExactlyWhatIsStaleRuns) {
  const Names all = {"bench", "other", "tables", "again", "change", "hull"};
  program_ = top_ / "graspbench";
  fs::copy_file(GRASPBENCH_PROGRAM, program_);
  WritePipeline();
  EXPECT_EQ(FindStale(), all);
  EXPECT_EQ(RunStale(), all);
  std::mt19937 random(20);
  for (int i = 0; i < NumChanges(); ++i) {
    Names stale;
    std::string what;
    const unsigned kind = i < 3 ? 2 * static_cast<unsigned>(i) : random() % 8;
    if (kind == 0) {
      what = "input s.yaml";
      comment_ += "# more\n";
      stale = FindBehind("bench");
    } else if (kind == 1) {
      what = "input contacts.json";
      blanks_ += " ";
      stale = FindBehind("hull");
    } else if (kind == 2) {
      what = "code";
      std::ofstream(program_, std::ios::binary | std::ios::app) << 'x';
      stale = all;
    } else if (kind == 3) {
      what = "parameter set";
      ++mass_;
      stale = FindBehind("other");
    } else if (kind == 4) {
      what = "parameter records";
      has_records_ = !has_records_;
      stale = FindBehind("tables");
    } else {
      auto stage = all.begin();
      std::advance(stage, random() % all.size());
      const fs::path folder = top_ / "out" / *stage;
      const std::string file = PickFile(folder, random);
      what = "output " + *stage + "/" + file;
      if (kind == 5) fs::remove(folder / file);
      if (kind == 6) std::ofstream(folder / file, std::ios::app) << 'x';
      if (kind == 7) WriteFile(folder / "added", "x");
      stale = {*stage};
    }
    SCOPED_TRACE(std::to_string(i) + ": " + what);
    WritePipeline();
    EXPECT_EQ(FindStale(), stale);
    EXPECT_EQ(RunStale(), stale);
    EXPECT_EQ(FindStale(), Names());
    EXPECT_EQ(RunStale(), Names());
  }
}

// A longer one, in which a kill finds something to interrupt.
class InterruptedPipeline : public RunPipelineTest {
 protected:
  InterruptedPipeline() {
    WriteFile(top_ / "p.yaml",
              "stages:\n"
              "  a: {command: run, parameters: {hand: tum, object: golf_ball, trials: 5}}\n"
              "  b: {command: judge, inputs: {folder: a}}\n"
              "  c: {command: export, inputs: {folder: b}, parameters: {records: true}}\n"
              "  d: {command: run, parameters: {hand: shadow, object: golf_ball, trials: 2}}\n");
    EXPECT_EQ(Run("\"$GB\" pipeline run p.yaml --out whole"), 0) << Log();
    EXPECT_EQ(Run("\"$GB\" pipeline pack p.yaml whole.tar --out whole"), 0) << Log();
  }
  void ExpectWhole() const {
    EXPECT_EQ(Run("\"$GB\" pipeline run p.yaml --out out"), 0) << Log();
    EXPECT_EQ(Run("\"$GB\" pipeline pack p.yaml out.tar --out out"), 0) << Log();
    EXPECT_TRUE(ReadFile(top_ / "whole.tar") == ReadFile(top_ / "out.tar"));
  }
  /** Processes that work in the folder of results. */
  int CountStages() const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::error_code status;
      count += fs::read_symlink(entry.path() / "cwd", status) == fs::canonical(top_ / "out");
    }
    return count;
  }
};

TEST_F(InterruptedPipeline, KilledAtRandomItEndsWithTheSameBytes) {
  std::mt19937 random(9);
  int num_killed = 0;
  for (int i = 0; i < 6; ++i) {
    const pid_t child = Start("\"$GB\" pipeline run p.yaml --out out");
    std::this_thread::sleep_for(std::chrono::milliseconds(200 + random() % 900));
    ::kill(child, SIGKILL);
    num_killed += Wait(child) == -SIGKILL;
  }
  EXPECT_GE(num_killed, 2);
  for (int i = 0; i < 200 && CountStages() > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(CountStages(), 0);  // stages end with the pipeline
  ExpectWhole();
}

TEST_F(InterruptedPipeline, InterruptedItGoesOnWhereItWas) {
  const pid_t child = Start("\"$GB\" pipeline run p.yaml --out out --jobs 1");
  for (int i = 0; i < 1000 && !fs::exists(top_ / "out" / "a" / "journal" / "0.jsonl"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::kill(child, SIGTERM);
  EXPECT_EQ(Wait(child), 75) << Log();
  EXPECT_NE(Log().find("repeat the command to continue"), std::string::npos) << Log();
  EXPECT_EQ(Run("\"$GB\" pipeline run p.yaml --out out"), 0);
  EXPECT_NE(Log().find("a: graspbench run --resume --out=a"), std::string::npos) << Log();
  ExpectWhole();
}

TEST_F(InterruptedPipeline, TwoAtOnceDoNotMeet) {
  const pid_t first = Start("\"$GB\" pipeline run p.yaml --out out");
  for (int i = 0; i < 1000 && !fs::exists(top_ / "out" / "a"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const pid_t second = Start("\"$GB\" pipeline run p.yaml --out out 2>second");
  EXPECT_EQ(Wait(second), 5);
  EXPECT_EQ(Wait(first), 0);
  ExpectWhole();
}

TEST_F(RunPipelineTest, PlacesThatCannotBeWritten) {
  WritePipeline();
  WriteFile(top_ / "file", "x");
  for (const char* place : {"file/out", "/proc/graspbench", "/sys/graspbench"}) {
    EXPECT_EQ(Run(std::string("\"$GB\" pipeline run p.yaml --out ") + place), 5) << Log();
  }
}

#ifdef GRASPBENCH_FAIL_FILES
TEST_F(InterruptedPipeline, FilesThatFailAtRandom) {
  int num_failed = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    const int code =
        Run("env LD_PRELOAD=" GRASPBENCH_FAIL_FILES " GRASPBENCH_FAULTS='" + std::to_string(seed) +
            " 0.004 /out/' \"$GB\" pipeline run p.yaml --out out");
    EXPECT_TRUE(code == 0 || code == 5) << code << "\n" << Log();
    num_failed += code != 0;
  }
  EXPECT_GE(num_failed, 1);
  ExpectWhole();
}
#endif

}  // namespace
}  // namespace graspbench
