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
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** The error's kind and text, whatever it is. */
template <class Do>
std::pair<ErrorKind, std::string> FindError(Do&& action) {
  try {
    action();
  } catch (const Error& e) {
    return {e.kind(), e.what()};
  }
  ADD_FAILURE() << "no error was thrown";
  return {ErrorKind::kUnsupported, ""};
}

void ExpectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in:\n" << text;
}

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

TEST_F(SessionStore, GivesBackWhatWasAppended) {
  const auto plan = CreateFakeSession(folder(), 10);
  AppendAll(0, plan);
  const Session session = LoadSession(folder());
  EXPECT_EQ(session.plan, plan);
  EXPECT_EQ(session.config.trials, 10);
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes(plan));
  EXPECT_EQ(session.findings.Format(), "");
  EXPECT_TRUE(FindUnfinished(session).empty());
}

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

TEST_F(SessionStore, ResumesWithThePlanMinusTheFinished) {
  const auto plan = CreateFakeSession(folder(), 2);
  AppendAll(0, {plan[5], plan[0]});
  const Session session = LoadSession(folder());
  ASSERT_EQ(session.records.size(), 2u);
  EXPECT_EQ(session.records[0].plan, plan[0]);
  EXPECT_EQ(session.records[1].plan, plan[5]);
  auto expected = plan;
  expected.erase(expected.begin() + 5);
  expected.erase(expected.begin());
  EXPECT_EQ(FindUnfinished(session), expected);
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

TEST_F(SessionStore, PlacesAreThoseOfThePlan) {
  const auto plan = CreateFakeSession(folder(), 3);
  AppendAll(0, {plan[5], plan[0]});
  AppendAll(1, {plan[5], plan[2]});
  const Session session = LoadSession(folder(), OnDamage::kRefuse, RecordParts::kPlaces);
  EXPECT_TRUE(session.records.empty());
  ASSERT_EQ(session.lines.trials.size(), plan.size());
  for (const size_t i : {0u, 2u, 5u}) {
    EXPECT_EQ(ParseJournalLine(ReadLine(session.lines, session.lines.trials[i])).plan, plan[i]);
  }
  EXPECT_EQ(NameOfLine(session.lines, session.lines.trials[5]), "journal/0.jsonl:1");
  EXPECT_EQ(session.lines.trials[1].file, -1);
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
  const auto [kind, message] = FindError([&] { LoadWhole(brief, brief.records[1]); });
  EXPECT_EQ(kind, ErrorKind::kFormat);
  ExpectHas(message, "journal/0.jsonl:2 has changed since the session was loaded");
  WriteText(journal(0), text.substr(0, second + 40));
  EXPECT_EQ(FindError([&] { LoadWhole(brief, brief.records[1]); }).first, ErrorKind::kIo);
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
              "journal/0.jsonl:4: warning: the last line was not finished when the program "
              "stopped; it counts as not there");
  }
  // The next line starts on a line of its own, and the torn one stays as a finding.
  WriteText(journal(0), whole.substr(0, whole.size() - 20));
  SealStore(kSessionStore, folder());
  AppendAll(0, {plan.back()});
  const Session session = LoadSession(folder());
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes(plan));
  ExpectHas(session.findings.Format(), "journal/0.jsonl:4: warning: skipped: the line is cut off");
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
    const auto [kind, text] = FindError([&] { LoadSession(folder()); });
    ASSERT_EQ(kind, ErrorKind::kFormat);
    ExpectHas(text, "\n  journal/0.jsonl:2: ");
    const Session session = LoadSession(folder(), OnDamage::kAccept);
    ASSERT_EQ(session.damage.size(), 1u);
    ASSERT_EQ(session.records.size(), plan.size() - 1) << "byte " << i;
    const auto unfinished = FindUnfinished(session);
    ASSERT_EQ(unfinished.size(), 1u);
    ASSERT_EQ(unfinished[0], plan[1]);
    ExpectHas(session.findings.Format(), "journal/0.jsonl:2: warning: skipped: ");
    ExpectHas(session.findings.Format(), "it counts as not there");
  }
}

TEST_F(SessionStore, LinesOfAnotherSessionAreDamageThatIsNamedAndMayBeAccepted) {
  const auto plan = CreateFakeSession(folder(), 1);
  PlannedTrial stranger = plan[0];
  stranger.object = "elephant";
  AppendAll(0, {stranger, plan[1]});
  const std::string place = "journal/0.jsonl:1: trial " + plan[0].id + " is not in the plan";
  const auto [kind, text] = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(kind, ErrorKind::kFormat);
  ExpectHas(text, "\n  " + place);
  ExpectHas(text, "--set-aside");
  const Session session = LoadSession(folder(), OnDamage::kAccept);
  EXPECT_EQ(JsonOf(session.records), JsonOfFakes({plan[1]}));
  ASSERT_EQ(session.damage.size(), 1u);
}

TEST_F(SessionStore, AWholeLineThatIsNoTrialIsDamage) {
  const auto plan = CreateFakeSession(folder(), 1);
  const std::pair<Json, std::string> lines[] = {
      {{{"elephant", 1}}, "it is a line of another kind of journal"},
      {{{"trial_id", 1}, {"hand", 2}, {"result", 3}}, "it is no record of this version"}};
  for (const auto& [line, found] : lines) {
    WriteText(journal(3), FormatCheckedLine(line) + "\n");
    const auto [kind, text] = FindError([&] { LoadSession(folder()); });
    EXPECT_EQ(kind, ErrorKind::kFormat);
    ExpectHas(text, "journal/3.jsonl:1: " + found);
  }
}

TEST_F(SessionStore, RefusesUnequalDuplicates) {
  const auto plan = CreateFakeSession(folder(), 1);
  AppendAll(0, plan);
  TrialRecord other = MakeFakeRecord(plan[2]);
  other.result.grip_force += 1e-12;
  JournalWriter(folder(), 1).Append(other);
  const auto [kind, text] = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(kind, ErrorKind::kFormat);
  ExpectHas(text, "one trial has different results");
  ExpectHas(text, "journal/1.jsonl:1: error: trial " + plan[2].id +
                      " (shadow, mug, g3, number 0) differs from journal/0.jsonl:3");
}

TEST_F(SessionStore, RefusesASecondSessionInTheFolder) {
  CreateFakeSession(folder(), 1);
  const auto [kind, text] = FindError([&] { CreateFakeSession(folder(), 1); });
  EXPECT_EQ(kind, ErrorKind::kUsage);
  ExpectHas(text, "already holds a session; continue it with --resume");
}

TEST_F(SessionStore, SaysThatThereIsNoSession) {
  EXPECT_FALSE(HasSession(folder()));
  const auto [kind, text] = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(kind, ErrorKind::kNotFound);
  ExpectHas(text, "no session in \"" + folder().string() + "\" (session.json is not there)");
}

TEST_F(SessionStore, RefusesAnotherSchema) {
  CreateFakeSession(folder(), 1);
  Json frozen = Json::parse(ReadFile(folder() / "session.json"));
  frozen["schema"] = 7;
  frozen["program_version"] = "9.9.9";
  frozen["config"] = "of some other kind";
  WriteText(folder() / "session.json", frozen.dump());
  const auto [kind, text] = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(kind, ErrorKind::kVersion);
  ExpectHas(text, "has schema 7, this program (");
  ExpectHas(text, "reads schema 6; use graspbench 9.9.9 for it, or rerun the session");
}

TEST_F(SessionStore, TellsOfADamagedConfigurationOrPlan) {
  CreateFakeSession(folder(), 1);
  const std::string frozen = ReadFile(folder() / "session.json");
  WriteText(folder() / "session.json", frozen.substr(0, frozen.size() / 2));
  auto error = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(error.first, ErrorKind::kFormat);
  ExpectHas(error.second, "session.json\" is damaged: ");

  Json json = Json::parse(frozen);
  json["config"].erase("seed");
  json["config"]["sim"]["stp_s"] = 1;
  WriteText(folder() / "session.json", json.dump());
  error = FindError([&] { LoadSession(folder()); });
  EXPECT_EQ(error.first, ErrorKind::kFormat);
  ExpectHas(error.second, "\n  session.json: has ");
  error = FindError([&] { LoadSession(folder(), OnDamage::kAccept); });
  EXPECT_EQ(error.first, ErrorKind::kFormat);
  ExpectHas(error.second, "error: seed: is missing");
  ExpectHas(error.second, "error: sim.stp_s: unknown key; did you mean \"step_s\"?");

  WriteText(folder() / "session.json", frozen);
  const std::string plan = ReadFile(folder() / "plan.jsonl");
  WriteText(folder() / "plan.jsonl", "{}\n" + plan + plan.substr(0, plan.find('\n')));
  error = FindError([&] { LoadSession(folder(), OnDamage::kAccept); });
  EXPECT_EQ(error.first, ErrorKind::kFormat);
  ExpectHas(error.second, "plan.jsonl\" is damaged");
  ExpectHas(error.second, "plan.jsonl:1: error: ");
  ExpectHas(error.second, "plan.jsonl:6: error: trial ");
  ExpectHas(error.second, " is planned twice");
}

TEST_F(SessionStore, ListsTheSettingsThatDifferOnResume) {
  CreateFakeSession(folder(), 3);
  const Session session = LoadSession(folder());
  SessionConfig config = session.config;
  CheckSameSession(session, config, session.plan);
  config.trials = 4;
  config.sim.step = 0.001;
  const auto [kind, text] =
      FindError([&] { CheckSameSession(session, config, MakePlan(config, MakeFakeInputs())); });
  EXPECT_EQ(kind, ErrorKind::kUsage);
  ExpectHas(text, "\n  trials: 3 and 4\n  sim.step_s: 0.002 and 0.001\n");
}

TEST_F(SessionStore, NamesTheFirstConditionThatDiffersOnResume) {
  CreateFakeSession(folder(), 1);
  const Session session = LoadSession(folder());
  SessionConfig config = session.config;
  config.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  const auto [kind, text] = FindError([&] { CheckSameSession(session, config, session.plan); });
  EXPECT_EQ(kind, ErrorKind::kUsage);
  ExpectHas(text, "\n  condition 1: none and heavy\n");
}

TEST_F(SessionStore, NamesTheCellsWhoseInputsChangedOnResume) {
  CreateFakeSession(folder(), 3);
  const Session session = LoadSession(folder());
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands[1].grasps[2].q_target[0] += 0.1;  // g3 of shadow
  const auto [kind, text] = FindError(
      [&] { CheckSameSession(session, session.config, MakePlan(session.config, inputs)); });
  EXPECT_EQ(kind, ErrorKind::kUsage);
  ExpectHas(text, "has changed since");
  ExpectHas(text, "\n  shadow, mug, g3\n");
  EXPECT_EQ(text.find("pencil"), std::string::npos) << text;
}

TEST_F(SessionStore, AFullDiskIsAnErrorAndTheNextLineIsWhole) {
  const auto plan = CreateFakeSession(folder(), 1);
  fs::create_symlink("/dev/full", journal(0));
  {
    JournalWriter writer(folder(), 0);
    const auto [kind, text] = FindError([&] { writer.Append(MakeFakeRecord(plan[0])); });
    EXPECT_EQ(kind, ErrorKind::kIo);
    ExpectHas(text, "cannot write \"" + journal(0).string() +
                        "\": No space left on device; free some space and resume");
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
  ExpectHas(session.findings.Format(), "journal/0.jsonl:2: warning: skipped: ");
}

TEST_F(SessionStore, AFolderThatCannotBeWrittenIsAnError) {
  WriteText(temporary_.path() / "file", "in the way");
  auto error = FindError([&] { CreateFakeSession(temporary_.path() / "file" / "session", 1); });
  EXPECT_EQ(error.first, ErrorKind::kIo);
  ExpectHas(error.second, "cannot create folder");
  ExpectHas(error.second, "Not a directory");

  error = FindError([&] { CreateFakeSession("/proc/graspbench", 1); });  // even root cannot
  EXPECT_EQ(error.first, ErrorKind::kIo);
  ExpectHas(error.second, "cannot create folder \"/proc/graspbench/journal\"");

  CreateFakeSession(folder(), 1);
  fs::remove_all(folder() / "journal");
  error = FindError([&] { JournalWriter writer(folder(), 0); });
  EXPECT_EQ(error.first, ErrorKind::kIo);
  ExpectHas(error.second, "cannot open \"" + journal(0).string() + "\": No such file");
  EXPECT_TRUE(LoadSession(folder()).records.empty());
}

TEST_F(SessionStore, TwoProcessesCannotWriteOneJournal) {
  CreateFakeSession(folder(), 1);
  JournalWriter first(folder(), 0);
  JournalWriter other_worker(folder(), 1);
  const auto [kind, text] = FindError([&] { JournalWriter second(folder(), 0); });
  EXPECT_EQ(kind, ErrorKind::kIo);
  ExpectHas(text, "is being written by another process");
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

}  // namespace
}  // namespace graspbench
