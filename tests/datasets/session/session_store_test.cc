#include "datasets/session/session_store.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/random.h"
#include "datasets/journal/checked_line.h"
#include "datasets/session/judgement_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

namespace fs = std::filesystem;

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Json JsonOf(const std::vector<TrialRecord>& records) {
  Json json = Json::array();
  for (const TrialRecord& record : records) json.push_back(ToJson(record));
  return json;
}

Json JsonOfFakes(const std::vector<PlannedTrial>& plan) {
  Json json = Json::array();
  for (const PlannedTrial& planned : plan) json.push_back(ToJson(MakeFakeRecord(planned)));
  return json;
}

/** Names and bytes of everything that must not depend on workers and interruptions. */
std::map<std::string, std::string> ReadResults(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const char* name : {"session.json", "plan.jsonl", "index.sqlite", "export/trials.csv",
                           "export/trials.schema.json", "export/events.csv",
                           "export/datapackage.json", "export/records.jsonl"}) {
    content[name] = ReadFile(folder / name);
  }
  return content;
}

class SessionStore : public ::testing::Test {
 protected:
  void AppendAll(int worker, const std::vector<PlannedTrial>& trials) {
    JournalWriter journal(folder(), worker);
    for (const PlannedTrial& planned : trials) journal.Append(MakeFakeRecord(planned));
  }
  fs::path folder() const { return temporary_.path() / "session"; }
  fs::path journal(int worker) const {
    return folder() / "journal" / (std::to_string(worker) + ".jsonl");
  }

  TemporaryFolder temporary_;
};

TEST_F(SessionStore, ExportsEveryFinishedTrialInThePlansOrder) {
  const auto plan = CreateFakeSession(folder(), 2);
  AppendAll(0, {plan[6], plan[1], plan[3]});
  ExportSession(folder(), LoadSession(folder()), true);
  const std::vector<PlannedTrial> finished = {plan[1], plan[3], plan[6]};
  std::string lines;
  for (const Json& record : JsonOfFakes(finished)) lines += record.dump() + "\n";
  EXPECT_EQ(ReadFile(folder() / "export" / "records.jsonl"), lines);
  const std::string csv = ReadFile(folder() / "export" / "trials.csv");
  size_t from = 0;
  for (const PlannedTrial& planned : finished) {
    from = csv.find("\n" + planned.id + "," + planned.hand + ",", from);
    ASSERT_NE(from, std::string::npos) << csv;
  }
}

TEST_F(SessionStore, ResultsDoNotDependOnWorkersOrderOrDuplicates) {
  std::map<std::string, std::string> expected;
  RandomStream random("store", "shuffle");
  for (const int workers : {1, 2, 4, 7}) {
    fs::remove_all(folder());
    auto trials = CreateFakeSession(folder(), 6);
    for (size_t i = trials.size() - 1; i > 0; --i) {
      std::swap(trials[i], trials[static_cast<size_t>(random.NextIndex(static_cast<int>(i) + 1))]);
    }
    trials.push_back(trials[3]);  // an equal duplicate
    std::vector<std::thread> threads;
    for (int worker = 0; worker < workers; ++worker) {
      threads.emplace_back([&, worker] {
        JournalWriter writer(folder(), worker);
        for (size_t i = static_cast<size_t>(worker); i < trials.size();
             i += static_cast<size_t>(workers)) {
          writer.Append(MakeFakeRecord(trials[i]));
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    ExportSession(folder(), LoadSession(folder()), true);
    if (expected.empty()) expected = ReadResults(folder());
    EXPECT_EQ(ReadResults(folder()), expected) << workers << " workers";
    ExportSession(folder(), LoadSession(folder()), true);  // idempotent
    EXPECT_EQ(ReadResults(folder()), expected);
  }
}

TEST_F(SessionStore, BriefRecordsAreReadAgainAsAWhole) {
  auto plan = CreateFakeSession(folder(), 6);
  AppendAll(1, {plan.begin(), plan.begin() + 9});
  WriteText(folder() / "journal" / "2.jsonl", "\n\n");  // blank lines count
  AppendAll(2, {plan.rbegin(), plan.rend() - 7});       // the last ones backwards, two again
  Judgement judgement;
  judgement.loads = {{"force +x", 2.5, true}};
  judgement.breaking_force = 2.5;
  JudgementWriter(folder(), 0).Append(plan[4].id, judgement);
  const Session whole = LoadSession(folder());
  const Session brief = LoadSession(folder(), OnDamage::kRefuse, RecordParts::kBrief);
  ASSERT_EQ(brief.records.size(), plan.size());
  EXPECT_EQ(brief.findings.Format(), whole.findings.Format());
  std::vector<TrialRecord> again;
  ForEachWhole(brief, [&](const TrialRecord& record) { again.push_back(record); });
  EXPECT_EQ(JsonOf(again), JsonOf(whole.records));
  for (const TrialRecord& record : brief.records) {
    EXPECT_TRUE(record.result.snapshots.empty() && record.result.touches.empty() &&
                record.result.phases.empty() && record.result.contact_events.empty());
  }
  EXPECT_EQ(again[4].judgement->loads.size(), 1u);
  ExportSession(folder(), whole, true);
  const auto expected = ReadResults(folder());
  ExportSession(folder(), brief);
  EXPECT_TRUE(ReadResults(folder()) == expected);
}

TEST_F(SessionStore, ALineThatHasChangedSinceItWasLoadedIsNamed) {
  const auto plan = CreateFakeSession(folder(), 1);
  AppendAll(0, plan);
  const Session brief = LoadSession(folder(), OnDamage::kRefuse, RecordParts::kBrief);
  std::string text = ReadFile(journal(0));
  const size_t second = text.find('\n') + 1;
  text[second + 30] ^= 1;
  WriteText(journal(0), text);
  LoadWhole(brief, brief.records[0]);
  EXPECT_TRUE(Throws([&] { LoadWhole(brief, brief.records[1]); }, ErrorKind::kFormat,
                     "journal/0.jsonl:2 has changed since the session was loaded"));
  WriteText(journal(0), text.substr(0, second + 40));
  EXPECT_TRUE(Throws([&] { LoadWhole(brief, brief.records[1]); }, ErrorKind::kIo));
}

TEST_F(SessionStore, KilledAtAnyMomentLosesNoFinishedTrial) {
  const auto plan = CreateFakeSession(folder(), 40);
  auto* acknowledged = static_cast<std::atomic<int>*>(::mmap(nullptr, sizeof(std::atomic<int>),
                                                             PROT_READ | PROT_WRITE,
                                                             MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(acknowledged, MAP_FAILED);
  RandomStream random("store", "kill");
  size_t num_finished = 0;
  for (int round = 0; round < 20; ++round) {
    const auto unfinished = FindUnfinished(LoadSession(folder()));
    SealStore(kSessionStore, folder());  // as a run does when it begins
    acknowledged->store(0);
    const pid_t child = ::fork();
    if (child == 0) {
      JournalWriter writer(folder(), round % 3);
      for (const PlannedTrial& planned : unfinished) {
        writer.Append(MakeFakeRecord(planned));
        acknowledged->fetch_add(1);
      }
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(random.NextIndex(8000)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const int promised = acknowledged->load();
    const Session session = LoadSession(folder());
    ASSERT_GE(session.records.size(), num_finished + static_cast<size_t>(promised));
    ASSERT_LE(session.records.size(), num_finished + static_cast<size_t>(promised) + 1);
    num_finished = session.records.size();
  }
  ::munmap(acknowledged, sizeof(std::atomic<int>));
  EXPECT_GT(num_finished, 0u);

  AppendAll(0, FindUnfinished(LoadSession(folder())));
  ExportSession(folder(), LoadSession(folder()), true);
  const auto interrupted = ReadResults(folder());
  fs::remove_all(folder());
  AppendAll(0, CreateFakeSession(folder(), 40));
  ExportSession(folder(), LoadSession(folder()), true);
  EXPECT_TRUE(ReadResults(folder()) == interrupted);
}

TEST_F(SessionStore, CutAnywhereTheJournalLosesTheCutTrialOnly) {
  const auto plan = CreateFakeSession(folder(), 1);
  AppendAll(0, plan);
  const std::string whole = ReadFile(journal(0));
  const size_t last_start = whole.rfind('\n', whole.size() - 2) + 1;
  for (size_t length = last_start + 1; length < whole.size(); length += 97) {
    WriteText(journal(0), whole.substr(0, length));
    const Session session = LoadSession(folder());
    ASSERT_EQ(session.records.size(), plan.size() - 1) << length;
    ASSERT_EQ(session.findings.Format(),
              "journal/0.jsonl:4: warning: the last line is incomplete because the program was "
              "stopped; it is ignored");
  }
  // The next line starts on a line of its own, and the torn one stays as a finding.
  WriteText(journal(0), whole.substr(0, whole.size() - 20));
  SealStore(kSessionStore, folder());
  AppendAll(0, {plan.back()});
  const Session session = LoadSession(folder());
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes(plan));
  EXPECT_TRUE(Has(session.findings.Format(),
                  "journal/0.jsonl:4: warning: skipped: the line is truncated or not a record"));
}

TEST_F(SessionStore, AFlippedByteCostsItsTrialOnly) {
  const auto plan = CreateFakeSession(folder(), 1);
  AppendAll(0, plan);
  const std::string whole = ReadFile(journal(0));
  const size_t start = whole.find('\n') + 1, end = whole.find('\n', start);
  for (size_t i = start; i < end; i += 97) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    WriteText(journal(0), damaged);
    const std::string text = FindError([&] { LoadSession(folder()); });
    EXPECT_TRUE(Has(text, "\n  journal/0.jsonl:2: "));
    const Session session = LoadSession(folder(), OnDamage::kAccept);
    ASSERT_EQ(session.damage.size(), 1u);
    ASSERT_EQ(session.records.size(), plan.size() - 1) << "byte " << i;
    const auto unfinished = FindUnfinished(session);
    ASSERT_EQ(unfinished.size(), 1u);
    ASSERT_EQ(unfinished[0], plan[1]);
    EXPECT_TRUE(Has(session.findings.Format(), "journal/0.jsonl:2: warning: skipped: "));
    EXPECT_TRUE(Has(session.findings.Format(), "; it is ignored"));
  }
}

TEST_F(SessionStore, LinesOfAnotherSessionAreDamageThatIsNamedAndMayBeAccepted) {
  const auto plan = CreateFakeSession(folder(), 1);
  PlannedTrial stranger = plan[0];
  stranger.object = "elephant";
  AppendAll(0, {stranger, plan[1]});
  const std::string place = "journal/0.jsonl:1: trial " + plan[0].id + " is not in the plan";
  const std::string text = FindError([&] { LoadSession(folder()); });
  EXPECT_TRUE(Has(text, "\n  " + place));
  EXPECT_TRUE(Has(text, "--set-aside"));
  const Session session = LoadSession(folder(), OnDamage::kAccept);
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes({plan[1]}));
  ASSERT_EQ(session.damage.size(), 1u);
}

TEST_F(SessionStore, RefusesUnequalDuplicates) {
  const auto plan = CreateFakeSession(folder(), 1);
  AppendAll(0, plan);
  TrialRecord other = MakeFakeRecord(plan[2]);
  other.result.grip_force += 1e-12;
  JournalWriter(folder(), 1).Append(other);
  const std::string text = FindError([&] { LoadSession(folder()); });
  EXPECT_TRUE(Has(text, "one trial has different results"));
  EXPECT_TRUE(Has(text, "journal/1.jsonl:1: error: trial " + plan[2].id +
                            " (shadow, mug, g3, number 0) differs from journal/0.jsonl:3"));
}

// That of its configuration: frozen_folder_test.
TEST_F(SessionStore, TellsOfADamagedPlan) {
  CreateFakeSession(folder(), 1);
  const std::string plan = ReadFile(folder() / "plan.jsonl");
  WriteText(folder() / "plan.jsonl", "{}\n" + plan + plan.substr(0, plan.find('\n')));
  const std::string text = FindError([&] { LoadSession(folder(), OnDamage::kAccept); });
  EXPECT_TRUE(Has(text, "plan.jsonl:1: error: "));
  EXPECT_TRUE(Has(text, "plan.jsonl:6: error: trial "));
  EXPECT_TRUE(Has(text, " is planned twice"));
}

TEST_F(SessionStore, ListsTheSettingsThatDifferOnResume) {
  CreateFakeSession(folder(), 3);
  const Session session = LoadSession(folder());
  SessionConfig config = session.config;
  CheckSameSession(session, config, session.plan);
  config.trials = 4;
  config.sim.step = 0.001;
  EXPECT_TRUE(Throws([&] { CheckSameSession(session, config, MakePlan(config, MakeFakeInputs())); },
                     ErrorKind::kUsage, "\n  trials: 3 and 4\n  sim.step_s: 0.002 and 0.001\n"));
  config = session.config;
  config.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  EXPECT_TRUE(Has(FindError([&] { CheckSameSession(session, config, session.plan); }),
                  "\n  condition 1: none and heavy\n"));
}

TEST_F(SessionStore, NamesTheCellsWhoseInputsChangedOnResume) {
  CreateFakeSession(folder(), 3);
  const Session session = LoadSession(folder());
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands[1].grasps[2].q_target[0] += 0.1;  // g3 of shadow
  const auto resume = [&] {
    CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  };
  EXPECT_TRUE(Throws(resume, ErrorKind::kUsage, "has changed since"));
  EXPECT_TRUE(Has(FindError(resume), "\n  shadow, mug, g3\n"));
  EXPECT_EQ(FindError(resume).find("pencil"), std::string::npos);
}

TEST_F(SessionStore, NamesTheArmWhoseFileChangedOnResume) {
  CreateFakeSession(folder(), 3);
  Session session = LoadSession(folder());
  session.config.arm.model = "arms/mine";
  SessionInputs inputs = MakeFakeInputs();
  MountedArm mounted;
  for (const char* hash : {"a", "b"}) {  // started with, and edited
    auto arm = std::make_shared<Arm>();
    arm->content_hash = hash;
    mounted.arm = arm;
    for (SessionHand& hand : inputs.hands) hand.arm = std::make_shared<MountedArm>(mounted);
    if (hash[0] == 'a') session.plan = MakePlan(session.config, inputs);
  }
  EXPECT_TRUE(Has(FindError([&] {
                    CheckSameSession(session, session.config, MakePlan(session.config, inputs));
                  }),
                  "a hand, an object, a grasp, the arm \"arms/mine\" or the physics has changed"));
}

TEST_F(SessionStore, AFullDiskIsAnErrorAndTheNextLineIsWhole) {
  const auto plan = CreateFakeSession(folder(), 1);
  fs::create_symlink("/dev/full", journal(0));
  {
    JournalWriter writer(folder(), 0);
    EXPECT_TRUE(Throws([&] { writer.Append(MakeFakeRecord(plan[0])); }, ErrorKind::kIo,
                       "cannot write \"" + journal(0).string() +
                           "\": No space left on device; free some space and resume"));
  }
  fs::remove(journal(0));

  // A limit in the middle of the second line; lifted, the same writer goes on.
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    JournalWriter writer(folder(), 0);
    writer.Append(MakeFakeRecord(plan[0]));
    const rlimit tight = {fs::file_size(journal(0)) + 100, RLIM_INFINITY};
    const rlimit open = {RLIM_INFINITY, RLIM_INFINITY};
    ::setrlimit(RLIMIT_FSIZE, &tight);
    bool failed = false;
    try {
      writer.Append(MakeFakeRecord(plan[1]));
    } catch (const Error& e) {
      failed = e.kind() == ErrorKind::kIo;
    }
    ::setrlimit(RLIMIT_FSIZE, &open);
    writer.Append(MakeFakeRecord(plan[2]));
    ::_exit(failed ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  const Session session = LoadSession(folder(), OnDamage::kAccept);
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes({plan[0], plan[2]}));
  EXPECT_TRUE(Has(session.findings.Format(), "journal/0.jsonl:2: warning: skipped: "));
}

TEST_F(SessionStore, AFolderThatCannotBeWrittenIsAnError) {
  EXPECT_TRUE(Throws([] { CreateFakeSession("/proc/graspbench", 1); },  // even root cannot
                     ErrorKind::kIo, "cannot create folder \"/proc/graspbench/journal\""));
  CreateFakeSession(folder(), 1);
  fs::remove_all(folder() / "journal");
  EXPECT_TRUE(Throws([&] { JournalWriter writer(folder(), 0); }, ErrorKind::kIo,
                     "cannot open \"" + journal(0).string() + "\": No such file"));
  EXPECT_TRUE(LoadSession(folder()).records.empty());
}

TEST_F(SessionStore, TwoProcessesCannotWriteOneJournal) {
  CreateFakeSession(folder(), 1);
  JournalWriter first(folder(), 0);
  JournalWriter other_worker(folder(), 1);
  EXPECT_TRUE(Throws([&] { JournalWriter second(folder(), 0); }, ErrorKind::kIo,
                     "is being written by another process"));
}

TEST_F(SessionStore, TheIndexAnswersQuestionsInSql) {
  const auto plan = CreateFakeSession(folder(), 10);
  AppendAll(0, {plan.begin(), plan.begin() + 15});
  const Session session = LoadSession(folder());
  ExportSession(folder(), session);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder() / "index.sqlite").c_str(), &db), SQLITE_OK);
  const auto ask = [&](const std::string& sql) {
    std::string answer;
    const auto add = [](void* text, int count, char** values, char**) {
      for (int i = 0; i < count; ++i) {
        *static_cast<std::string*>(text) +=
            std::string(i > 0 ? "|" : "") + (values[i] ? values[i] : "NULL");
      }
      *static_cast<std::string*>(text) += "\n";
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), add, &answer, nullptr), SQLITE_OK)
        << sqlite3_errmsg(db);
    return answer;
  };
  EXPECT_EQ(ask("PRAGMA integrity_check"), "ok\n");
  EXPECT_EQ(ask("SELECT hand, object, grasp, planned, finished FROM cells"),
            "tum|mug|g2|10|10\ntum|pencil|g2|10|5\nshadow|mug|g3|10|0\nshadow|pencil|g1|10|0\n");
  EXPECT_EQ(ask("SELECT count(*), sum(success) FROM trials"),
            ask("SELECT sum(finished), sum(successes) FROM cells"));
  EXPECT_EQ(
      ask("SELECT wilson_low, wilson_high, success_rate FROM cells WHERE finished = 0 LIMIT 1"),
      "0.0|1.0|NULL\n");
  EXPECT_EQ(ask("SELECT count(*) FROM trials WHERE t_LF_s IS NOT NULL"), "0\n");
  sqlite3_close(db);
}

// Columns are named after digits, which a record names as it likes; SQL compares without case.
TEST_F(SessionStore, DigitsThatMakeNoColumnsAreAnError) {
  const auto plan = CreateFakeSession(folder(), 1);
  TrialRecord record = MakeFakeRecord(plan[0]);
  const auto export_with = [&](const std::string& digit) {
    record.result.contacts[0].digit = digit;
    Session session;
    session.plan = plan;
    session.records = {record};
    ExportSession(folder(), session);
  };
  export_with("a \"digit\", so'); DROP TABLE trials");
  EXPECT_TRUE(
      Throws([&] { export_with("th"); }, ErrorKind::kFormat, "index.sqlite cannot be made"));
}

TEST(DamagedRecords, AreReadFromLinesThatFailTheirChecksum) {
  const TemporaryFolder temporary;
  const std::vector<PlannedTrial> plan = CreateFakeSession(temporary.path(), 2);
  {
    JournalWriter writer(temporary.path(), 0);
    for (const PlannedTrial& planned : plan) writer.Append(MakeFakeRecord(planned));
  }
  SealStore(kSessionStore, temporary.path());
  const auto journal = temporary.path() / "journal" / "0.jsonl";
  std::string lines = ReadFile(journal);
  lines.insert(lines.find("\"num_steps\":") + 12, "1");  // of the first trial
  const size_t second = lines.find('\n') + 1;
  lines[second] = '#';  // no JSON any more
  WriteFileAtomically(journal, lines);
  const Session session = LoadSession(temporary.path(), OnDamage::kAccept, RecordParts::kBrief);
  const std::vector<TrialRecord> records = ReadDamagedRecords(session);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].plan.id, plan[0].id);
  TrialRecord expected = MakeFakeRecord(plan[0]);
  EXPECT_NE(records[0].result.num_steps, expected.result.num_steps);
  expected.result.num_steps = records[0].result.num_steps;
  EXPECT_EQ(ToJson(records[0]), ToJson(expected));
  // A whole line of the trial, in any journal, is what counts.
  JournalWriter(temporary.path(), 1).Append(MakeFakeRecord(plan[0]));
  EXPECT_TRUE(ReadDamagedRecords(LoadSession(temporary.path(), OnDamage::kAccept)).empty());
}

}  // namespace

}  // namespace graspbench
