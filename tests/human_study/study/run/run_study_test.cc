#include "human_study/study/run/run_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/study/output/motion_bids.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/run/prepare_recording.h"
#include "human_study/study/suggest/suggest_settings.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/human_study/faults.h"
#include "tests/support/mocap_data.h"
#include "tests/support/shared_data.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** Three people, two sizes, two trials each, on disk: as it is, analysed once, and in a copy to
change. Two universes are enough to see that they differ. */
class RunStudyTest : public FolderTest {
 protected:
  static void SetUpTestSuite() {
    SyntheticOptions options;
    options.seed = "run_study_test";
    options.num_people = 3;
    options.trials_per_size = 2;
    options.diameters = {0.03, 0.06};
    trials_ = MakeSyntheticStudy(options);
    demo_ = fs::path(::testing::TempDir()) / "run_study";
    fs::remove_all(demo_);
    WriteDemoStudy(trials_, demo_);
    std::ofstream(demo_ / "study.yaml", std::ios::app)
        << "multiverse:\n  onset: []\n  cutoff_hz: [8]\n  detector: [speed]\n  opening: []\n"
           "bias_trials: 0\n";
    const Study study = LoadStudy(demo_ / "study.yaml");
    StudyWatch watch;
    MotionBidsWriter bids(demo_ / "bids", study);
    watch.on_row = [](size_t, size_t) { ++num_rows_; };
    watch.on_trial = [&](const StudyTrial& trial, const ReachTrial& reach) {
      bids.WriteTrial(trial, reach);
      reaches_.push_back(reach);
    };
    result_ = RunStudy(study, watch);
    bids.Finish();
  }
  static void TearDownTestSuite() { fs::remove_all(demo_); }

  void SetUp() override {
    FolderTest::SetUp();
    fs::copy(demo_, folder_, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
  void Replace(const std::string& name, const std::string& what, const std::string& with) const {
    std::string text = Read(name);
    const size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    Write(name, text.replace(at, what.size(), with));
  }
  fs::path FileOf(size_t trial) const {
    return folder_ / "recordings" / SyntheticFileName(trials_[trial], SyntheticFormat::kC3d);
  }
  /** The changed study. */
  StudyResult Run() const { return RunStudy(LoadStudy(folder_ / "study.yaml")); }

  inline static fs::path demo_;
  inline static std::vector<SyntheticTrial> trials_;
  inline static std::vector<ReachTrial> reaches_;
  inline static size_t num_rows_ = 0;
  inline static StudyResult result_;
};

TEST_F(RunStudyTest, TheTruthComesOutAtTheEndOfTheWay) {
  const StudyResult& result = result_;
  ASSERT_EQ(result.trials.size(), 12u);
  EXPECT_EQ(result.CountKept(), 12);
  EXPECT_EQ(num_rows_, 12u);
  EXPECT_NEAR(result.rate, 200.0, 1e-3);
  EXPECT_NEAR(result.noise, 0.0003, 0.0001);
  const TruthComparison errors = CompareWithTruth(result, trials_);
  EXPECT_LT(std::abs(errors.contact->mean), 0.005);
  EXPECT_LT(*errors.contact->standard_deviation, 0.010);
  EXPECT_LT(std::abs(errors.gft->mean), 0.005);

  ASSERT_FALSE(result.statistics.measures.empty());
  const MeasureStatistics& first = result.statistics.measures.front();
  ASSERT_TRUE(first.cells.has_value()) << first.cells.reason();
  EXPECT_EQ(first.cells->persons.size(), 3u);
  ASSERT_TRUE(first.anova.has_value()) << first.anova.reason();

  // People open wider for the larger object.
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    if (std::string(statistics.measure.id) != "peak_opening_m") continue;
    EXPECT_GT(statistics.by_cell[1]->mean, statistics.by_cell[0]->mean + 0.01);
  }
  EXPECT_EQ(result.statistics.openings.rows.size(), HandOpeningList().size());
  EXPECT_GT(*result.statistics.openings.rows.front().criteria[1], 1.0);
  EXPECT_TRUE(result.statistics.bias.empty());
}

TEST_F(RunStudyTest, AUniverseIsTheStudyUnderOtherChoices) {
  const StudyResult& result = result_;
  ASSERT_EQ(result.universes.size(), 4u);  // two cut-offs, two detectors
  EXPECT_TRUE(result.universes.front().is_own);
  const size_t other = 3;
  EXPECT_EQ(result.universes[other].detector, "speed");
  EXPECT_EQ(result.universes[other].cutoff, 8.0);
  Append("study.yaml", "contact: {detector: speed, cutoff_hz: 8}\n");
  const StudyResult changed = Run();
  const TrialMeasure& measure = FindMeasure(result.study.config.multiverse.measure);
  for (size_t i = 0; i < result.trials.size(); ++i) {
    EXPECT_EQ(result.trials[i].universes[0], measure.value(*result.trials[i].analysis));
    EXPECT_EQ(result.trials[i].universes[other], measure.value(*changed.trials[i].analysis));
  }
}

TEST_F(RunStudyTest, ATrialThatCannotBeAnalysedIsRemovedWithItsReason) {
  fs::resize_file(FileOf(1), 0);
  fs::remove(FileOf(2));
  const StudyResult result = Run();
  EXPECT_EQ(result.CountKept(), 10);
  EXPECT_FALSE(result.trials[1].removed.empty());
  ExpectHolds(result.trials[2].removed, "trial-003.c3d");
  EXPECT_FALSE(result.trials[2].analysis.has_value());
}

TEST_F(RunStudyTest, AMarkerThatNoRecordingHasIsAFaultOfTheStudy) {
  Replace("study.yaml", "index_tip", "index_tp");
  const std::string fault = FaultOf([&] { Run(); });
  ExpectHolds(fault, "study.yaml:7: error: markers.index: no recording has it");
  ExpectHolds(fault, "did you mean \"index_tip\"?");
}

TEST_F(RunStudyTest, ARecordingWithoutOneMarkerCostsItsTrialsAlone) {
  const fs::path file = FileOf(4);
  std::string bytes = ReadFile(file);
  const size_t at = bytes.find("ring_tip");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 8, "rong_tip");
  WriteFileAtomically(file, bytes);
  const StudyResult result = Run();
  EXPECT_EQ(result.CountKept(), 11);
  ExpectHolds(result.trials[4].removed, "no marker for the ring");
  ExpectHolds(result.trials[4].removed, "did you mean \"rong_tip\"?");
}

// A copy has the same noise, whatever its file is called.
TEST_F(RunStudyTest, ACopiedRecordingCountsOnce) {
  WriteFileAtomically(FileOf(7), ReadFile(FileOf(1)));
  const StudyResult result = Run();
  EXPECT_EQ(result.CountKept(), 11);
  EXPECT_EQ(result.trials[7].removed_code, "same_recording");
  ExpectHolds(result.trials[7].removed, "those of " + result.trials[1].id);
}

/** Points 10 mm apart that move alike: 50 samples at 100 Hz. */
Recording MakeRecording(const std::vector<const char*>& labels) {
  Recording recording;
  recording.rate = 100.0;
  recording.num_frames = 50;
  for (const char* label : labels) {
    RecordedPoint& point = recording.points.emplace_back();
    point.label = label;
    for (int i = 0; i < 50; ++i) point.Append(i, 10.0 * double(recording.points.size()), i % 7);
  }
  SetLengthUnit(recording, "mm", "test");
  return recording;
}

StudyConfig MakeConfig() {
  StudyConfig config;
  config.markers.tips.thumb = {"thumb"};
  config.markers.tips.index = {"index"};
  return config;
}

TEST(PrepareRecording, ATimeOfYearsIsAFault) {
  Recording recording = MakeRecording({"thumb", "index"});
  for (int i = 0; i < 50; ++i) recording.times.push_back(i < 49 ? 0.01 * i : 1e300);
  EXPECT_EQ(FaultOf([&] { PrepareRecording(recording, MakeConfig()); }),
            "the recording's 50 samples span 1e+300 s, one interval alone 1e+300 s: a time is "
            "wrong. Correct it, or cut the recording there");
}

TEST(PrepareRecording, AMarkerThatIsNeverSeenIsAMissingOne) {
  Recording recording = MakeRecording({"thumb", "index", "wrist", "top", "side"});
  StudyConfig config = MakeConfig();
  config.markers.wrist = {"wrist"};
  config.markers.object = {"top", "side"};
  EXPECT_TRUE(PrepareRecording(recording, config).missing.empty());
  const auto hide = [&](size_t point) {
    for (size_t i = 0; i < 50; ++i) recording.points[point].SetInvalid(i);
    const PreparedRecording prepared = PrepareRecording(recording, config);
    return prepared.missing.empty() ? std::string() : prepared.missing.back().text;
  };
  const auto unseen = [](const std::string& what, const std::string& label) {
    return "no marker for the " + what + ": \"" + label +
           "\" has no place in any sample of the recording";
  };
  EXPECT_EQ(hide(3), "") << "the other marker shows the object";
  EXPECT_EQ(hide(4), unseen("object", "side"));
  config.markers.object.clear();
  EXPECT_EQ(hide(2), unseen("wrist", "wrist"));
  config.markers.wrist.clear();
  EXPECT_EQ(hide(0), unseen("thumb", "thumb"));
}

/** A study of one plain table, thumb and index in one place each. */
class OneTable : public FolderTest {
 protected:
  /** @param step  between its rows, of which the last is at `end`. */
  void WriteTable(double end, double step, double place_per_time) const {
    std::string table = "time,t_x,t_y,t_z,i_x,i_y,i_z\n";
    for (int i = 0; i * step < end + 1e-9; ++i) {
      const std::string x = std::to_string(place_per_time * i * step);
      table += std::to_string(i * step) + "," + x + ",0,0," + x + ",40,0\n";
    }
    Write("a.csv", table);
    Write("trials.csv", "participant,file\nP1,a.csv\n");
  }
  /** What a person is told, with these lines under markers and points. */
  std::string Run(const std::string& markers, const std::string& points) const {
    Write("study.yaml", "recording: {mapping: columns.yaml}\nmarkers: {thumb: thumb, index: index" +
                            markers + "}\n");
    Write("columns.yaml",
          "unit: mm\ntime: time\npoints:\n  thumb: [t_x, t_y, t_z]\n  index: [i_x, i_y, i_z]\n" +
              points);
    std::string removed;
    const std::string fault = FaultOf(
        [&] { removed = RunStudy(LoadStudy(folder_ / "study.yaml")).trials.front().removed; });
    return fault.empty() ? removed : fault;
  }
};

TEST_F(OneTable, OneMarkerUnderTwoDigitsIsRefused) {
  WriteTable(0.1, 0.01, 100.0);
  const std::string middle = ", middle: middle";
  ExpectHolds(Run(middle, "  middle: [i_x, i_y, i_z]\n"),
              "the index and the middle are at the same place in all 11 samples");
  EXPECT_EQ(Run(middle, "  middle: [i_x, i_z, i_y]\n").find("same place"), std::string::npos);
}

TEST_F(OneTable, TimesInMillisecondsAreToldAsSuch) {
  WriteTable(1995.0, 5.0, 1.0);
  ExpectHolds(Run("", ""),
              "0.2 samples a second, too few for a reach: its times may be in milliseconds "
              "(time_unit: ms");
}

TEST_F(RunStudyTest, BytesThatAreNoTextAreEscapedInTheTables) {
  WriteFileAtomically(FileOf(1), "\x9f\xe2\x28\xa1,\xff\n\xc0\xc1,1\n");
  WriteStudyTables(Run(), folder_ / "a");
  EXPECT_TRUE(IsUtf8(ReadFile(folder_ / "a" / "trials.csv")));
}

TEST_F(RunStudyTest, TheWrongFolderIsToldAsSuch) {
  ExpectHolds(FaultOf([&] { RunStudy(LoadStudy(folder_ / "study.yaml", folder_ / "elsewhere")); }),
              "--data DIR names another folder");
}

TEST_F(RunStudyTest, TablesHoldEveryTrialAndEventAndTheSameBytes) {
  const StudyResult& result = result_;
  WriteStudyTables(result, folder_ / "a");
  size_t num_rows = 0;
  AnalyseStudy(LoadStudy(folder_ / "study.yaml"), folder_ / "b",
               [&](size_t, size_t) { ++num_rows; });
  EXPECT_EQ(num_rows, result.trials.size());
  EXPECT_TRUE(fs::exists(folder_ / "b" / "bids" / "dataset_description.json"));
  EXPECT_FALSE(fs::is_empty(folder_ / "b" / "tidy"));
  for (const char* name : {"trials", "events", "measures", "statistics"}) {
    const std::string csv = Read(std::string("a/") + name + ".csv");
    EXPECT_EQ(csv, Read(std::string("b/") + name + ".csv"));
    const Json schema = Json::parse(Read(std::string("a/") + name + ".schema.json"));
    const std::string heading = csv.substr(0, csv.find('\n'));
    EXPECT_EQ(static_cast<size_t>(std::count(heading.begin(), heading.end(), ',')) + 1,
              schema.at("fields").size());
  }
  const std::string measures = Read("a/measures.csv");
  EXPECT_EQ(std::count(measures.begin(), measures.end(), '\n'), 13);
  const std::vector<StudyEvent> events = ListEvents(result.trials[0], result.study.config);
  std::vector<std::string> names;
  for (const StudyEvent& event : events) {
    if (event.name != "contact") names.push_back(event.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"movement_start", "movement_onset", "maximum_opening",
                                             "last_maximum_opening", "object_moved", "lift_off",
                                             "reacceleration", "movement_end"}));
  EXPECT_EQ(events.size(), names.size() + 5 * ContactDetectorList().size());
}

TEST_F(RunStudyTest, TheBidsDerivativeReadsBackAsTheCleanedTrial) {
  const Recording recording =
      LoadRecording(demo_ / "bids" / "sub-01" / "motion" /
                    "sub-01_task-reachtograsp_tracksys-markers_run-1_desc-cleaned_motion.tsv");
  ASSERT_EQ(recording.num_frames, reaches_[0].times.size());
  EXPECT_NEAR(recording.rate, 200.0, 1e-6);
  const RecordedPoint& thumb = recording.FindPoint("thumb_tip");
  for (size_t i = 0; i < recording.num_frames; i += 50) {
    EXPECT_LT((thumb.Position(i) - reaches_[0].digits[0].tip.At(i)).norm(), 1e-6);
  }
  double onset = -1.0;
  for (const RecordedEvent& event : recording.events) {
    if (event.label == "movement_onset") onset = event.time;
  }
  EXPECT_NEAR(onset, result_.trials[0].analysis->movement.onset.time - result_.trials[0].begin,
              1e-6);
}

TEST(FindReaches, GoFromOneFarthestPlaceToTheNext) {
  // A tip that swings between 0.05 and 0.35 m from a marker, farthest at 0, 2, 4 and 6 s.
  PreparedRecording recording;
  for (int i = 0; i <= 650; ++i) recording.times.push_back(0.01 * i);
  const auto sample = [&](double middle, double swing) {
    Trajectory track;
    track.times = recording.times;
    track.states.assign(track.times.size(), SampleState::kMeasured);
    track.p.setZero(3, static_cast<Eigen::Index>(track.times.size()));
    for (size_t i = 0; i < track.times.size(); ++i) {
      track.p(0, static_cast<Eigen::Index>(i)) = middle + swing * std::cos(M_PI * track.times[i]);
    }
    return track;
  };
  recording.digits.resize(1);
  recording.digits[0].tip = sample(0.2, 0.15);
  recording.object_markers.push_back(sample(0.0, 0.0));
  CutConfig cut;
  cut.near = 0.08;
  cut.far = 0.15;
  const std::vector<Reach> reaches = FindReaches(recording, cut);
  ASSERT_EQ(reaches.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(reaches[i].begin, 2.0 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(reaches[i].end, 2.0 * static_cast<double>(i) + 2.0, 1e-9);
  }
  cut.far = 0.4;  // never as far as this
  EXPECT_TRUE(FindReaches(recording, cut).empty());
}

/** Reasons of the trials that were removed, each without what differs between trials. */
std::map<std::string, int> CountReasons(const StudyResult& result) {
  std::map<std::string, int> counts;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept())
      ++counts[trial.removed.substr(0, trial.removed.find_first_of("0123456789"))];
  }
  return counts;
}

TEST_F(RunStudyTest, ACompanionThatNoRecordingHasIsTold) {
  Replace("study.yaml", "  wrist: wrist\n",
          "  companions: {thumb: thumb_middle}\n  wrist: wrist\n");
  const StudyResult result = Run();
  EXPECT_EQ(result.CountKept(), 0);
  EXPECT_EQ(result.trials[0].removed.substr(0, 80),
            "no marker for the companion of the thumb: the recording has no \"thumb_middle\". K");
}

// The multiverse's cut-off alone is too high: the message names it, and the proposal is enough.
TEST_F(RunStudyTest, AStatedCutoffThatDoesNotFitIsRefusedAndTheProposalMends) {
  SyntheticOptions options;
  options.seed = "run_study_slow";
  options.num_people = 1;
  options.trials_per_size = 2;
  options.diameters = {0.06};
  options.rate = 30.0;
  WriteDemoStudy(MakeSyntheticStudy(options), folder_);
  Append("study.yaml", "multiverse: {cutoff_hz: [10, 20]}\nbias_trials: 0\n");
  const Study study = LoadStudy(folder_ / "study.yaml");
  const StudyResult refused = RunStudy(study);
  EXPECT_EQ(refused.CountKept(), 0);
  EXPECT_EQ(refused.trials[0].removed_code, "cutoff_too_high");
  EXPECT_EQ(refused.trials[0].removed.rfind("multiverse.cutoff_hz is 20; ", 0), 0u)
      << refused.trials[0].removed;
  const StudySuggestions suggestions = SuggestSettings(study);
  ASSERT_EQ(suggestions.suggestions.size(), 1u);
  const std::vector<std::string>& settings = suggestions.suggestions[0].settings;
  const StudyResult mended = RunStudy(LoadStudy(folder_ / "study.yaml", {}, settings));
  EXPECT_EQ(mended.CountKept(), suggestions.num_kept_then);
  EXPECT_GT(mended.CountKept(), 0);
  Replace("study.yaml", "multiverse: {cutoff_hz: [10, 20]}\n", "");
  EXPECT_EQ(Run().CountKept(), mended.CountKept()) << "without any, they follow the rate";
}

TEST(StudyExamples, ThirtyHertzOfAStrangerAreAnalysed) {
  const fs::path folder = FindSharedData() / "strangers" / "people" / "hz30";
  if (!fs::exists(folder)) GTEST_SKIP() << "shared data are not here";
  const StudyResult result = RunStudy(LoadStudy(folder / "study.yaml"));
  EXPECT_EQ(result.trials.size(), 8u);
  EXPECT_EQ(result.CountKept(), 8);
  Diagnostics problems;
  DataTable truth(ReadFile(folder / "truth.csv"), "truth.csv", problems);
  const char* const columns[] = {"c_thumb", "c_index", "c_middle", "c_ring", "c_little"};
  double squares = 0.0, count = 0.0;
  for (size_t i = 0; i < result.trials.size(); ++i) {
    if (!result.trials[i].IsKept()) continue;
    for (size_t d = 0; d < 5; ++d) {
      const EventTime& contact = result.trials[i].analysis->contacts[d].contact;
      if (!contact.IsFound()) continue;
      const double error = contact.time - truth.Number(i, columns[d]);
      squares += error * error;
      count += 1.0;
      EXPECT_LT(std::abs(error), 2.0 * contact.CalcHalfWidth()) << result.trials[i].id;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.5 / 30.0);  // half a frame
}

TEST_F(OneTable, AStrangersBadFileIsNamedAndTheOthersGoOn) {
  const fs::path people = FindSharedData() / "strangers" / "people" / "hz30";
  const fs::path files = FindSharedData() / "strangers" / "files";
  if (!fs::exists(people) || !fs::exists(files)) GTEST_SKIP() << "shared data are not here";
  fs::copy(people, folder_);
  for (const char* name : {"event_used_neg.c3d", "event_used_nan.c3d"}) {
    fs::copy(files / name, folder_ / name);
    Append("trials.csv", std::string("P1,") + name + "," + name + ",cyl\n");
  }
  const StudyResult result = RunStudy(LoadStudy(folder_ / "study.yaml"));
  ASSERT_EQ(result.trials.size(), 10u);
  EXPECT_GE(result.CountKept(), 6);
  const auto has_finding = [&](const std::string& file) {
    return std::any_of(result.findings.begin(), result.findings.end(), [&](const auto& found) {
      return found.file == file && found.finding.where == "EVENT:USED";
    });
  };
  for (size_t i = 8; i < 10; ++i) {
    EXPECT_FALSE(result.trials[i].removed.empty());
    EXPECT_TRUE(has_finding(result.trials[i].file));
  }
}

TEST(StudyExamples, DfkiRunsEndToEnd) {
  GRASPBENCH_REQUIRE_MOCAP(recording, "dfki-hand_embodiment/recording.tsv");
  const StudyResult result =
      RunStudy(LoadStudy(FindDataRoot() / "human_study/examples/dfki/study.yaml", FindMocapData()));
  EXPECT_EQ(result.trials.size(), 21u);
  EXPECT_EQ(result.CountKept(), 14);
  // Where the pillow hides the thumb for longer than its companion may fill.
  EXPECT_EQ(CountReasons(result)["no contact of the thumb: the digit is hidden in the hold"], 5);
}

TEST(StudyExamples, KinesisRunsEndToEnd) {
  GRASPBENCH_REQUIRE_MOCAP(recording, "kinesis/rtgData.txt");
  const StudyResult result = RunStudy(
      LoadStudy(FindDataRoot() / "human_study/examples/kinesis/study.yaml", FindMocapData()));
  EXPECT_EQ(result.trials.size(), 45u);
  EXPECT_EQ(result.num_resampled, 45);
  EXPECT_EQ(result.CountKept(), 28);  // one recorded at half the rate of the others
  const std::map<std::string, int> expected = {
      {"no hold: near the object all tips are hidden for a while and never rest together before or "
       "after it",
       6},
      // Nothing stops a digit at a virtual object: ten trials have contacts that are known badly.
      {"an event fell into a gap", 6},
      {"no contact of the index: it does not come nearer where it should touch", 1},
      {"no contact of the thumb: not usable here: digit or object hidden for ", 2},
      {"no onset of the movement: the threshold is never crossed before", 2}};
  EXPECT_EQ(CountReasons(result), expected);
}

}  // namespace
}  // namespace graspbench
