/** @file
Whoever asks why a trial failed gets the same digit, time and sentences: from its record, `trial`,
the shell's `why`, the trial's page, the session's table and its report. */

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/base/text/json.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct Regime {
  const char* name;
  std::vector<std::string> options;
  int least_failures;
};

std::ostream& operator<<(std::ostream& out, const Regime& regime) { return out << regime.name; }

class OneDiagnosisSlow : public testing::TestWithParam<Regime> {
 protected:
  void SetUp() override {
    top_ = fs::path(testing::TempDir()) /
           (std::string("diagnosis_") + GetParam().name + "_" + std::to_string(::getpid()));
    fs::remove_all(top_);
    fs::create_directories(top_);
    std::vector<std::string> command = {"run", "--out", folder()};
    command.insert(command.end(), GetParam().options.begin(), GetParam().options.end());
    ASSERT_EQ(Run(command, "run"), 0);
    ASSERT_EQ(Run({"export", folder(), "--records"}, "export"), 0);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(top_);
  }

  std::string folder() const { return (top_ / "session").string(); }
  /** What it prints goes into a file of that name. */
  int Run(const std::vector<std::string>& command, const std::string& out) const {
    const std::string file = (top_ / out).string();
    return WaitFor(Start(command, [&file] {
      ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
      ::dup2(::open("/dev/null", O_WRONLY), 2);
    }));
  }
  std::string Read(const std::string& file) const { return ReadFile(top_ / file); }

  fs::path top_;
};

/** The record of every trial that has a diagnosis. */
std::vector<Json> ListFailures(const fs::path& records) {
  std::vector<Json> failures;
  std::ifstream stream(records);
  for (std::string line; std::getline(stream, line);) {
    Json record = Json::parse(line);
    if (record["result"].contains("diagnosis") && !record["result"]["diagnosis"].is_null()) {
      failures.push_back(std::move(record));
    }
  }
  return failures;
}

/** The row of the failures' table that holds the words. */
std::string FindRow(const std::string& page, const std::string& words) {
  const size_t table = page.find("Every trial that did not succeed");
  const size_t at = page.find(words, table);
  if (table == page.npos || at == page.npos) return "";
  return page.substr(at, page.find("</tr>", at) - at);
}

TEST_P(OneDiagnosisSlow, IsTheSameEverywhere) {
  const std::vector<Json> failures = ListFailures(folder() + "/export/records.jsonl");
  ASSERT_GE(static_cast<int>(failures.size()), GetParam().least_failures);
  const std::string report = ReadFile(folder() + "/report/index.html");
  const std::string table = ReadFile(folder() + "/export/trials.csv");
  int num_same = 0;
  for (const Json& record : failures) {
    const std::string& id = record["trial_id"].str();
    Json diagnosis = record["result"]["diagnosis"];
    EXPECT_FALSE(diagnosis.contains("text")) << "records keep no words";
    const std::string page_file = (top_ / (id + ".html")).string();
    ASSERT_EQ(Run({"trial", folder(), id, "--json", "--page", page_file}, "json"), 0);
    const Json trial = Json::parse(Read("json"));
    const std::string text = trial["diagnosis"]["text"].str();
    SCOPED_TRACE(id + ": " + text);
    diagnosis["text"] = text;
    EXPECT_EQ(trial["diagnosis"].dump(), diagnosis.dump());
    EXPECT_EQ(
        Run({"shell", "-c", "open '" + folder() + "' " + id, "-c", "run", "-c", "why"}, "why"), 0);
    EXPECT_NE(Read("why").find("why      " + text + "\n"), std::string::npos) << Read("why");
    EXPECT_NE(Read(id + ".html").find(">" + text + "<"), std::string::npos);
    const std::string& name = trial["name"].str();
    EXPECT_NE(FindRow(report, ">" + name + "<").find(">" + diagnosis["mechanism"].str() + "<"),
              std::string::npos)
        << name;
    EXPECT_NE(report.find(text), std::string::npos) << "in the row of its values";
    EXPECT_NE(table.find(text), std::string::npos);
    num_same += !testing::Test::HasFailure();
    fs::remove(page_file);
  }
  std::cout << num_same << " of " << failures.size() << " failures have one diagnosis\n";
}

INSTANTIATE_TEST_SUITE_P(
    Regimes, OneDiagnosisSlow,
    testing::Values(Regime{"default", {}, 20},
                    Regime{"slippery", {"--set", "model.friction_scale=0.5"}, 60}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace graspbench
