#include "datasets/benchmark/entry_pack.h"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "tests/datasets/benchmark/tiny_benchmark.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Entries whose plan is that of the tiny benchmark, with results that nobody has simulated:
whether these are reproduced is for a simulation to say. */
class EntryPackTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { tiny_ = new Benchmark(MakeTinyBenchmark()); }
  static void TearDownTestSuite() { delete tiny_; }

  static EntryFacts MakeFacts() {
    return {"Mine",        "A. Person", "CC0-1.0",    "2026-11-28",
            "As shipped.", tiny_->name, tiny_->sha256};
  }
  /** @param num_left  trials that are not finished. */
  Session MakeSession(const std::string& name, const SessionConfig& config, size_t num_left = 0) {
    const fs::path folder = top_ / name;
    const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
    const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
    MakeFolder(folder);
    CopyInputs(config, folder);
    CopyRehearsed(inputs, folder);
    CreateSession(folder, config, plan);
    JournalWriter writer(folder, 0);
    for (size_t i = num_left; i < plan.size(); ++i) writer.Append(MakeFakeRecord(plan[i]));
    SealStore(kSessionStore, folder);
    return LoadSession(folder);
  }
  fs::path Pack(const std::string& name, const SessionConfig& config) {
    return Pack(name, MakeSession(name, config));
  }
  fs::path Pack(const std::string& name, const Session& session) {
    GatherEntry(session, MakeFacts(), top_ / ("of-" + name));
    WritePack(top_ / ("of-" + name), top_ / (name + ".tar"));
    return top_ / (name + ".tar");
  }
  /** Whoever changes a pack can make all its hashes again. */
  fs::path Change(const fs::path& pack, const std::function<void(const fs::path&)>& change) {
    fs::remove_all(top_ / "changed");
    Unpack(pack, top_ / "changed", kEntryPack);
    change(top_ / "changed");
    fs::remove(top_ / "changed" / "manifest.json");
    if (fs::exists(top_ / "changed" / "session" / "session.json")) {
      fs::remove(top_ / "changed" / "session" / "manifest.json");
      SealStore(kSessionStore, top_ / "changed" / "session");
    }
    SealPack(top_ / "changed", kEntryPack, {"graspbench entry SESSION", {}, {}});
    WritePack(top_ / "changed", top_ / "changed.tar");
    return top_ / "changed.tar";
  }
  std::string FindReason(const fs::path& pack) {
    fs::remove_all(top_ / "out");
    return FindError([&] { LoadEntry(pack, top_ / "out", *tiny_); });
  }
  std::string FindReason(const fs::path& pack, const std::function<void(const fs::path&)>& change) {
    return FindReason(Change(pack, change));
  }
  static void Replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = ReadFile(file);
    ASSERT_NE(text.find(from), text.npos) << file << ": " << text.substr(0, 500);
    text.replace(text.find(from), from.size(), to);
    WriteFile(file, text);
  }
  /** A tar file of these names. */
  fs::path WriteTar(const std::vector<std::string>& names) const {
    archive* out = ::archive_write_new();
    ::archive_write_set_format_pax_restricted(out);
    ::archive_write_open_filename(out, (top_ / "foreign.tar").c_str());
    for (const std::string& name : names) {
      archive_entry* entry = ::archive_entry_new();
      ::archive_entry_set_pathname(entry, name.c_str());
      ::archive_entry_set_filetype(entry, AE_IFREG);
      ::archive_entry_set_size(entry, 1);
      ::archive_entry_set_perm(entry, 0644);
      ::archive_write_header(out, entry);
      ::archive_write_data(out, "x", 1);
      ::archive_entry_free(entry);
    }
    ::archive_write_close(out);
    ::archive_write_free(out);
    return top_ / "foreign.tar";
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path();
  static Benchmark* tiny_;
};
Benchmark* EntryPackTest::tiny_ = nullptr;

TEST_F(EntryPackTest, WhatIsPackedComesOutAgain) {
  const Session session = MakeSession("s", tiny_->session);
  const fs::path pack = Pack("s", session);
  const Entry entry = LoadEntry(pack, top_ / "out", *tiny_);
  EXPECT_EQ(entry.facts.name, "Mine");
  EXPECT_EQ(entry.session.plan, session.plan);
  EXPECT_EQ(entry.session.records.size(), 4u);
  EXPECT_EQ(FindReason(Change(pack, [](const fs::path&) {})), "");
}

// What runs.json, exports, pages and the workers' files say is of no entry.
TEST_F(EntryPackTest, TheSameTrialsTheSameBytes) {
  const Session session = MakeSession("a/s", tiny_->session);
  const Session other = MakeSession("b/elsewhere/t", tiny_->session, 4);
  for (int worker : {2, 0, 1}) {
    for (size_t i = static_cast<size_t>(worker); i < other.plan.size(); i += 3) {
      JournalWriter(other.folder, worker).Append(MakeFakeRecord(other.plan[i]));
    }
  }
  SealStore(kSessionStore, other.folder);
  MakeFolder(other.folder / "report");
  WriteFile(other.folder / "report" / "index.html", "page");
  WriteFile(other.folder / "run.json", "{\"host\": \"elsewhere\"}");
  MakeFolder(top_ / "a");
  EXPECT_EQ(ReadFile(Pack("p", session)), ReadFile(Pack("q", LoadSession(other.folder))));
  EXPECT_EQ(ReadFile(top_ / "p.tar").find(top_.string()), std::string::npos);
}

TEST_F(EntryPackTest, WhatIsNotTheBenchmarksIsRefused) {
  SessionConfig config = tiny_->session;
  config.seed = 2;
  EXPECT_TRUE(Has(FindReason(Pack("seed", config)), "seed: 1 and 2"));
  config = tiny_->session;
  config.variation.offset = 0.0;
  EXPECT_TRUE(Has(FindReason(Pack("variation", config)), "variation.offset_m: 0.005 and 0"));
  config = tiny_->session;
  config.objects = {"golf_ball", "tennis_ball"};
  EXPECT_TRUE(Has(FindReason(Pack("objects", config)), "objects: "));
  config = tiny_->session;
  config.hands = {"shadow"};
  EXPECT_TRUE(Has(FindReason(Pack("hand", config)), "hands: \"shadow\""));
  config = tiny_->session;
  config.grasps = {"all"};
  EXPECT_TRUE(Has(FindReason(Pack("grasps", config)), "with more than one grasp"));
  config = tiny_->session;
  config.grasps = {"g1"};
  EXPECT_EQ(FindReason(Pack("g1", config)), "");
}

TEST_F(EntryPackTest, WhatCannotBeReplayedIsRefused) {
  EXPECT_TRUE(Has(FindReason(Pack("left", MakeSession("left", tiny_->session, 1))),
                  "1 trial is not finished, first tum-golf_ball"));
  SessionConfig config = tiny_->session;
  config.policy.command = "python3 mine.py";
  EXPECT_TRUE(Has(FindReason(Pack("policy", config)), "has no recorded actions"));
}

TEST_F(EntryPackTest, ChangedPacksAreFoundWhoeverMadeTheirHashesAgain) {
  const fs::path pack = Pack("s", tiny_->session);
  const fs::path journal = fs::path("session") / "journal" / "0.jsonl";
  const auto without = [&](size_t first, size_t count) {
    return [=](const fs::path& folder) {
      std::vector<std::string> lines;
      ForEachLine(ReadFile(folder / journal),
                  [&](std::string_view line, int, bool) { lines.emplace_back(line); });
      lines.erase(lines.begin() + long(first), lines.begin() + long(first + count));
      std::string text;
      for (const std::string& line : lines) text += line + "\n";
      WriteFile(folder / journal, text);
    };
  };
  EXPECT_TRUE(Has(FindReason(pack, without(1, 1)), "1 trial is not finished"));
  EXPECT_TRUE(Has(FindReason(pack, without(0, 4)), "4 trials are not finished"));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               const std::string text = ReadFile(folder / journal);
                               WriteFile(folder / journal,
                                         text + text.substr(0, text.find('\n') + 1));
                             }),
                  "its journal has 5 lines for 4 trials; expected one for each"));
  EXPECT_TRUE(
      Has(FindReason(pack,
                     [&](const fs::path& folder) {
                       TrialRecord record = MakeFakeRecord(MakePlan(
                           tiny_->session, LoadSessionInputs(tiny_->session, FieldUse::kLater))[0]);
                       record.result.lift_height = 1.0;
                       WriteFile(folder / journal,
                                 ReadFile(folder / journal) + FormatJournalLine(record) + "\n");
                     }),
          "one trial has different results"));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               PlannedTrial foreign;
                               foreign.id = "0123456789abcdef";
                               foreign.hand = "tum";
                               WriteFile(folder / journal,
                                         ReadFile(folder / journal) +
                                             FormatJournalLine(MakeFakeRecord(foreign)) + "\n");
                             }),
                  "0123456789abcdef"));
  // A trial under an id of its own, in the plan and in the journal.
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               std::string text;
                               for (TrialRecord record : LoadSession(folder / "session").records) {
                                 if (text.empty()) {
                                   Replace(folder / "session" / "plan.jsonl", record.plan.id,
                                           "0123456789abcdef");
                                   record.plan.id = "0123456789abcdef";
                                 }
                                 text += FormatJournalLine(record) + "\n";
                               }
                               WriteFile(folder / journal, text);
                             }),
                  "the plan is not what configuration, hand, object and grasps give: line 1"));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               Replace(folder / "session" / "session.json",
                                       "\"physics_version\": " + std::to_string(kPhysicsVersion),
                                       "\"physics_version\": 3");
                             }),
                  "simulated with physics version 3; tiny/1 is of version"));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               MakeFolder(folder / "session/inputs/hands/tum");
                               WriteFile(folder / "session/inputs/hands/tum/hand.yaml", "x");
                             }),
                  "the pack holds \"session/inputs/hands/tum/hand.yaml\", which no entry has"));
  EXPECT_TRUE(
      Has(FindReason(pack, [&](const fs::path& folder) { WriteFile(folder / "x.sh", "x"); }),
          "the pack holds \"x.sh\""));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               Replace(folder / "entry.json", tiny_->sha256, std::string(64, '0'));
                             }),
                  "another file of tiny/1"));
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               Replace(folder / "entry.json", "tiny/1", "tiny/2");
                             }),
                  "it is an entry of tiny/2 and not of tiny/1"));
  EXPECT_TRUE(Has(
      FindReason(
          pack, [&](const fs::path& folder) { WriteFile(folder / "entry.json", "{\"name\": 3}"); }),
      "entry.json cannot be read"));
}

TEST_F(EntryPackTest, TheGraspFilesOfAnEntryAreThoseOfItsPlan) {
  SessionConfig config = tiny_->session;
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
  const fs::path file = top_ / "my.yaml";
  Grasp mine = inputs.hands[0].grasps[0];
  mine.id = "mine";
  WriteFile(file, FormatGraspFile(*inputs.hands[0].hand, mine, "g1"));
  config.grasps = {file.string()};
  const fs::path pack = Pack("grasp", config);
  EXPECT_EQ(FindReason(pack), "");
  const fs::path copy = fs::path("session") / "inputs" / "grasps" / "0.yaml";
  EXPECT_TRUE(Has(FindReason(pack,
                             [&](const fs::path& folder) {
                               std::string text = ReadFile(folder / copy);
                               const size_t at = text.find_last_of("12345678");
                               text[at] = text[at] == '1' ? '2' : '1';
                               WriteFile(folder / copy, text);
                             }),
                  "the plan is not what configuration, hand, object and grasps give"));
  EXPECT_TRUE(Has(FindReason(pack, [&](const fs::path& folder) { fs::remove(folder / copy); }),
                  "is not in the pack"));
}

TEST_F(EntryPackTest, DamagedAndForeignFilesAreRefused) {
  const fs::path pack = Pack("s", tiny_->session);
  const std::string whole = ReadFile(pack);
  WriteFile(top_ / "cut.tar", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(Has(FindReason(top_ / "cut.tar"), "cut off or damaged"));
  std::string flipped = whole;
  flipped[flipped.find("As shipped.")] = 'a';
  WriteFile(top_ / "flipped.tar", flipped);
  EXPECT_TRUE(Has(FindReason(top_ / "flipped.tar"), "entry.json: its bytes have changed"));
  EXPECT_TRUE(Has(FindReason(WriteTar({"../evil"})), "no file below its own folder"));
  EXPECT_TRUE(Has(FindReason(WriteTar({"a", "a"})), "twice"));
  EXPECT_FALSE(fs::exists(top_ / "evil"));
  MakeFolder(top_ / "pipeline");
  WriteFile(top_ / "pipeline" / "x", "x");
  SealPack(top_ / "pipeline", kPipelinePack, {"make", {}, {}});
  WritePack(top_ / "pipeline", top_ / "pipeline.tar");
  EXPECT_TRUE(Has(FindReason(top_ / "pipeline.tar"), "kind \"pipeline\" and not \"entry\""));
}

TEST_F(EntryPackTest, TextsHaveALengthAndCanBeRead) {
  EntryFacts facts = MakeFacts();
  CheckFacts(facts);
  facts.name = std::string(40, 'x');
  CheckFacts(facts);
  facts.name += "x";
  EXPECT_TRUE(Has(FindError([&] { CheckFacts(facts); }), "name has 41 characters"));
  facts.name = " \n";
  EXPECT_TRUE(Has(FindError([&] { CheckFacts(facts); }), "name is empty"));
  facts.name = "\xff";
  EXPECT_TRUE(Has(FindError([&] { CheckFacts(facts); }), "not UTF-8"));
  facts = MakeFacts();
  for (const char* date : {"2026", "2026-13-01", "2026-11-28T10:00", "28.11.2026"}) {
    facts.date = date;
    EXPECT_TRUE(Has(FindError([&] { CheckFacts(facts); }), "is none; expected one as 2026-11-28"));
  }
  facts.date = "";
  CheckFacts(facts);
  EXPECT_EQ(DescribeYear(facts), "not declared");
  EXPECT_EQ(DescribeYear(MakeFacts()), "2026");
}

}  // namespace
}  // namespace graspbench
