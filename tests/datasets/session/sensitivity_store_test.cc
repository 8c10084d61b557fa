#include "datasets/session/sensitivity_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/checked_line.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

constexpr char kHalf[] = "model.mass_scale=0.5";

/** As earlier programs wrote their lines. */
class OldWriter {
 public:
  OldWriter(const std::filesystem::path& folder, int worker)
      : path_(folder / "sensitivity" / (std::to_string(worker) + ".jsonl")) {
    MakeFolder(path_.parent_path());
  }
  void Append(const std::string& setting, const std::string& id, const TrialMeasures& measures) {
    AppendFile(path_).Append(
        FormatCheckedLine(
            {{"setting", setting}, {"trial_id", id}, {"measures", RecordToJson(measures)}}) +
        "\n");
  }

 private:
  std::filesystem::path path_;
};

class SensitivityStore : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_ = CreateFakeSession(folder(), 2);
    JournalWriter journal(folder(), 0);
    for (const PlannedTrial& planned : plan_) journal.Append(MakeFakeRecord(planned));
  }
  std::filesystem::path folder() const { return temporary_.path() / "session"; }
  SensitivityData Load(OnDamage on_damage = OnDamage::kRefuse) {
    findings_ = {};
    return LoadSensitivity(LoadSession(folder(), on_damage), findings_);
  }
  TrialMeasures Measure(size_t place) const {
    return MakeTrialMeasures(MakeFakeRecord(plan_[place]).result);
  }

  TemporaryFolder temporary_;
  std::vector<PlannedTrial> plan_;
  Diagnostics findings_;
};

TEST_F(SensitivityStore, GivesBackWhatWasAppendedWhoeverWroteIt) {
  EXPECT_TRUE(Load().empty());
  OldWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  OldWriter(folder(), 1).Append(kHalf, plan_[1].id, Measure(1));
  OldWriter(folder(), 1).Append(kHalf, plan_[0].id, Measure(0));
  OldWriter(folder(), 1).Append("sim.step_s=0.001", plan_[0].id, Measure(1));
  const SensitivityData data = Load();
  EXPECT_TRUE(findings_.entries().empty()) << findings_.Format();
  ASSERT_EQ(data.size(), 2u);
  ASSERT_EQ(data.at(kHalf).size(), 2u);
  for (const size_t place : {0, 1}) {
    EXPECT_EQ(RecordToJson(data.at(kHalf).at(plan_[place].id)), RecordToJson(Measure(place)));
  }
}

TEST_F(SensitivityStore, DamageCostsTheLineAlone) {
  OldWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  OldWriter(folder(), 0).Append(kHalf, "0123456789abcdef", Measure(0));
  std::ofstream(folder() / "sensitivity" / "0.jsonl", std::ios::app) << "{\"x\":1}\n{\"cut";
  const SensitivityData data = Load(OnDamage::kAccept);
  EXPECT_EQ(data.at(kHalf).size(), 1u);
  const std::string text = findings_.Format();
  EXPECT_NE(text.find("sensitivity/0.jsonl:2: warning: skipped: trial 0123456789abcdef is not "
                      "finished; it counts as not there"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("sensitivity/0.jsonl:3: "), std::string::npos) << text;
  EXPECT_NE(text.find("sensitivity/0.jsonl:4: "), std::string::npos) << text;
}

TEST_F(SensitivityStore, TwoDifferentResultsAreRefused) {
  OldWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  OldWriter(folder(), 1).Append(kHalf, plan_[0].id, Measure(1));
  EXPECT_THROW(Load(), Error);
}

}  // namespace
}  // namespace graspbench
