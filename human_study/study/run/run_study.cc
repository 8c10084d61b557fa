#include "human_study/study/run/run_study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/statistics/tidy_export.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/output/motion_bids.h"
#include "human_study/study/output/study_tables.h"
#include "human_study/study/run/prepare_recording.h"
#include "human_study/study/run/recording_faults.h"
#include "human_study/study/run/trial_openings.h"
#include "human_study/study/run/trial_removal.h"
#include "human_study/study/run/usual_hands.h"

namespace graspbench {

namespace {

/** What the comment at the top of study.yaml says, if it names the recording or its folder: where
it is from. */
std::string QuoteComment(const std::string& study_file, const std::string& recording) {
  const std::string folder = recording.substr(0, recording.find('/'));
  std::istringstream stream(ReadFile(study_file));
  std::string comment, line;
  while (std::getline(stream, line) && !line.empty() && line[0] == '#') comment += "\n  " + line;
  if (folder.empty() || comment.find(folder) == std::string::npos) return "";
  return "\n" + study_file + " says of it:" + EscapeForTerminal(comment);
}

bool DiffersInDetectorOnly(const Universe& a, const Universe& b) {
  return a.onset == b.onset && a.opening == b.opening && a.cutoff == b.cutoff;
}

/** How far digits go on after they touched, from the contacts of included trials; few trials tell
as much as all. */
void LearnFrom(const std::vector<StudyTrial>& trials, StudyResult& result) {
  std::vector<TouchFit> fits;
  for (const StudyTrial& trial : trials) {
    if (!trial.IsKept()) continue;
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (digit.contact.IsFound() && digit.fit.missing.empty()) fits.push_back(digit.fit);
    }
  }
  result.num_learned = static_cast<int>(fits.size());
  result.study.config.analysis.contact.depths = LearnDepths(fits);
}

/** As corrections alone: what was confirmed is the contact that the study's own analysis has, so
that it stays the same under other choices. */
std::vector<ContactReview> SettleReviews(std::vector<ContactReview> reviews,
                                         const TrialAnalysis& analysis) {
  for (ContactReview& review : reviews) {
    if (review.verdict != ReviewVerdict::kConfirmed) continue;
    for (const DigitContactEvents& digit : analysis.contacts) {
      if (digit.digit != review.digit) continue;
      review.verdict = ReviewVerdict::kCorrected;
      review.contact = digit.contact.time;
      review.uncertainty = digit.contact.uncertainty;
    }
  }
  return reviews;
}

/** Goes through the rows of trials.csv and collects. */
class Runner {
 public:
  /** @param usual  where digits are in a person's other trials. */
  Runner(const StudyWatch& watch, const UsualHands& usual, StudyResult& result)
      : study_(result.study),
        watch_(watch),
        usual_(usual),
        result_(result),
        measures_(ListStudyMeasures(result.study)) {}

  void Run(const PlannedReach& planned) {
    StudyTrial trial;
    static_cast<TrialNames&>(trial) = planned;
    if (!planned.remove.empty()) {
      Remove({"left_out", planned.remove}, trial);
      return Add(trial);
    }
    try {
      Load(planned);
      if (!prepared_.missing.empty()) {
        Remove({"missing_marker", prepared_.missing.front().text}, trial);
        return Add(trial);
      }
      if (const std::string fault = FindCutoffFault(study_.config, prepared_.rate);
          !fault.empty()) {
        Remove({"cutoff_too_high", fault}, trial);
        return Add(trial);
      }
    } catch (const Error& error) {
      // What the disk or the network did says nothing of the recording.
      std::error_code status;
      const bool is_file =
          std::filesystem::is_regular_file(study_.recordings / planned.file, status) || status;
      if (error.kind() == ErrorKind::kIo && is_file) throw;
      if (error.kind() == ErrorKind::kEnvironment) throw;
      Remove({"unreadable", error.what()}, trial);
      loaded_.clear();
      return Add(trial);
    }
    for (const Reach& part : ListParts(planned, trial)) Analyse(trial, planned, part);
  }

  void Finish() {
    CheckMarkersFound();
    CheckReviews();
    SettleStandOff();
    CountRates();
    result_.noise = CalcMedian(noises_);
    result_.advised_cutoff = CalcMedian(cutoffs_);
  }

  void CountRates() {
    result_.rate = CalcMedian(rates_);
    if (rates_.empty()) return;
    result_.lowest_rate = *std::min_element(rates_.begin(), rates_.end());
    result_.highest_rate = *std::max_element(rates_.begin(), rates_.end());
  }

  const UsualHands& hands() const { return hands_; }

 private:
  static void Remove(const Removal& removal, StudyTrial& trial) {
    trial.removed_code = removal.code;
    trial.removed = EscapeForTerminal(removal.text);  // may hold bytes of a broken recording
  }

  void Add(StudyTrial trial) {
    trial.id = trial.participant + "-" + trial.trial;
    if (trial.universes.empty()) trial.universes.assign(result_.universes.size(), std::nan(""));
    result_.trials.push_back(std::move(trial));
  }

  /** Several rows may be parts of one recording. */
  void Load(const PlannedReach& planned) {
    const std::string key = planned.file + "\n" + planned.table_trial + "\n" + planned.hand;
    if (loaded_ == key) return;
    loaded_.clear();
    const Recording recording = LoadPlanned(study_, planned, tables_);
    for (ImportFinding finding : recording.findings) {
      finding.text = EscapeForTerminal(finding.text);
      result_.findings.push_back({planned.file, finding});
    }
    StudyConfig own = study_.config;
    own.markers = MarkersOfHand(own.markers, planned.hand);
    prepared_ = PrepareRecording(recording, own);
    loaded_ = key;
    ++num_read_;
    for (const MissingMarker& missing : prepared_.missing) {
      if (missing.digit < 0) continue;
      const auto digit = static_cast<size_t>(missing.digit);
      if (num_missing_[digit]++ == 0) missing_texts_[digit] = planned.file + ": " + missing.text;
    }
    if (prepared_.was_resampled) ++result_.num_resampled;
    result_.num_frozen += prepared_.num_frozen;
    result_.num_spikes += prepared_.num_spikes;
    result_.num_samples += prepared_.num_samples;
    rates_.push_back(prepared_.rate);
  }

  std::vector<Reach> ListParts(const PlannedReach& planned, StudyTrial& trial) {
    if (study_.config.cut.near == 0.0) return {{planned.start, planned.end}};
    std::vector<Reach> parts;
    for (const Reach& reach : FindReaches(prepared_, study_.config.cut)) {
      if (reach.begin >= planned.start && reach.end <= planned.end) parts.push_back(reach);
    }
    if (parts.empty()) {
      Remove({"no_reach",
              "no reach found: the hand is never first farther than cut.far_m and then nearer than "
              "cut.near_m"},
             trial);
      Add(trial);
    }
    return parts;
  }

  void Analyse(StudyTrial trial, const PlannedReach& planned, const Reach& part) {
    if (study_.config.cut.near > 0.0)
      trial.trial += "." + std::to_string(++num_parts_[planned.line]);
    std::optional<ReachTrial> reach;
    try {
      reach = MakeReachTrial(prepared_, part, study_.config, study_.FindObject(planned.object));
      trial.begin = reach->times.front();
      trial.end = reach->times.back();
      const AnalysisOptions options = FitCutoffs(study_.config.analysis, prepared_.rate);
      FilteredTrial filtered(*reach);
      trial.analysis = AnalyseTrial(filtered, options);
      std::vector<Doubt> faults = FindRecordingFaults(prepared_, *reach);
      for (Doubt& doubt : usual_.FindExchange(planned, *trial.analysis, *reach))
        faults.push_back(std::move(doubt));
      for (std::vector<Doubt>* doubts : {&trial.analysis->trial_doubts, &trial.analysis->doubts}) {
        doubts->insert(doubts->begin(), faults.begin(), faults.end());
      }
      Review(planned, options, trial, *trial.analysis);
      Remove(FindRemoval(*trial.analysis, study_.config.removal), trial);
      if (trial.IsKept()) RemoveCopy(*reach, trial);
      if (trial.IsKept()) hands_.Add(planned, *trial.analysis, *reach);
      if (trial.IsKept() && !result_.universes.empty()) {
        trial.openings = CalcOpenings(filtered, *trial.analysis, options);
        trial.opening_course = SampleOpening(*trial.analysis);
        CalcUniverses(filtered, trial);
        EstimateNoise(*reach);
      }
    } catch (const Error& error) {
      Remove({"unreadable", error.what()}, trial);
    }
    Add(std::move(trial));
    StudyTrial& added = result_.trials.back();
    if (added.analysis && watch_.on_analysed) watch_.on_analysed(added, *reach);
    if (added.IsKept() && watch_.on_trial) watch_.on_trial(added, *reach);
    if (!added.analysis) return;
    for (ScalarCurve* curve : {&added.analysis->speed, &added.analysis->opening}) {
      *curve = Thin(*curve, kNumDrawn);
    }
  }

  /** No two reaches have the same noise. */
  void RemoveCopy(const ReachTrial& reach, StudyTrial& trial) {
    const Eigen::Matrix3Xd& p = reach.digits.front().tip.p;
    const std::string bytes(reinterpret_cast<const char*>(p.data()),
                            static_cast<size_t>(p.size()) * sizeof(double));
    const std::string id = trial.participant + "-" + trial.trial;
    const auto [first, is_new] =
        first_of_.insert({CalcSha256(bytes), id + " (\"" + trial.file + "\")"});
    if (is_new) return;
    Remove({"same_recording",
            "its samples are those of " + first->second + ": a copy, and one reach counts once"},
           trial);
  }

  /** What a person said of this trial; a fault of that stops the run, as one of study.yaml does. */
  void Review(const PlannedReach& planned, const AnalysisOptions& options, StudyTrial& trial,
              TrialAnalysis& analysis) {
    const std::string id = planned.participant + "-" + trial.trial;
    for (const ContactReview& review : study_.reviews) {
      if (review.trial != id) continue;
      trial.reviews.push_back(review);
      reviewed_.insert(review.line);
    }
    for (const std::string& text : DropLapsed(analysis, 1.0 / prepared_.rate, trial.reviews)) {
      result_.warnings.push_back({"review_lapsed", study_.config.reviews + ", " + text});
    }
    try {
      ApplyReviews(trial.reviews, options, trial.begin, trial.end, 1.0 / prepared_.rate, analysis);
    } catch (const Error& error) {
      review_problems_.Fail(study_.config.reviews, trial.reviews.front().line, error.what());
    }
  }

  void CalcUniverses(FilteredTrial& reach, StudyTrial& trial) {
    const TrialMeasure& measure = FindMeasure(study_.config.multiverse.measure);
    trial.measure_universes.resize(measures_.size());
    const std::vector<ContactReview> reviews = SettleReviews(trial.reviews, *trial.analysis);
    trial.universes.reserve(result_.universes.size());
    for (std::vector<double>& values : trial.measure_universes) {
      values.reserve(result_.universes.size());
    }
    const Universe* previous = nullptr;
    TrialAnalysis analysis;
    for (const Universe& universe : result_.universes) {
      const AnalysisOptions options = MakeOptions(study_.config, universe, prepared_.rate);
      // Detectors vary fastest in the list, and one analysis asks all of them.
      if (previous != nullptr && DiffersInDetectorOnly(*previous, universe)) {
        BelieveDetector(universe.detector, options, analysis);
      } else {
        analysis = AnalyseTrial(reach, options);
        ApplyReviews(reviews, options, trial.begin, trial.end, 1.0 / prepared_.rate, analysis);
      }
      previous = &universe;
      trial.universes.push_back(measure.value(analysis));
      for (size_t i = 0; i < measures_.size(); ++i) {
        trial.measure_universes[i].push_back(measures_[i].value(analysis));
      }
    }
  }

  /** Of the thumb; a trial too short for it has none. */
  void EstimateNoise(const ReachTrial& reach) {
    try {
      const ResidualAnalysis residual = FindCutoff(reach.digits.front().tip);
      noises_.push_back(residual.noise / std::sqrt(3.0));
      if (std::isfinite(residual.cutoff)) cutoffs_.push_back(residual.cutoff);
    } catch (const Error&) {
    }
  }

  void CheckReviews() {
    std::vector<std::string> ids;
    for (const StudyTrial& trial : result_.trials) ids.push_back(trial.id);
    for (const ContactReview& review : study_.reviews) {
      if (reviewed_.count(review.line) > 0) continue;
      const bool is_known = std::find(ids.begin(), ids.end(), review.trial) != ids.end();
      review_problems_.Fail(
          study_.config.reviews, review.line,
          "trial \"" + review.trial + "\" " +
              (is_known ? std::string("could not be analysed")
                        : "is not of this study" + SuggestNames(review.trial, ids)));
    }
    review_problems_.ThrowIfErrors(ErrorKind::kFormat, "the reviews cannot be replayed");
  }

  /** Where a digit's marker sits is the same in all trials of a person: what is left of a distance
  without its median is the trial's. Nobody knows it of fewer than three trials. */
  void SettleStandOff() {
    std::map<std::pair<std::string, std::string>, std::vector<double*>> all;
    for (StudyTrial& trial : result_.trials) {
      if (!trial.analysis) continue;
      for (DigitContactEvents& digit : trial.analysis->contacts) {
        if (std::isnan(digit.stands_off)) continue;
        all[{trial.participant, digit.digit}].push_back(&digit.stands_off);
      }
    }
    for (const auto& [key, distances] : all) {
      std::vector<double> values;
      for (const double* distance : distances) values.push_back(*distance);
      const double usual = values.size() < 3 ? std::nan("") : CalcMedian(values);
      for (double* distance : distances) *distance -= usual;
    }
  }

  /** A label that no recording has is a fault of study.yaml, not of a trial. */
  void CheckMarkersFound() const {
    if (num_read_ == 0) {
      const auto failed = std::find_if(study_.trials.begin(), study_.trials.end(),
                                       [](const auto& t) { return t.remove.empty(); });
      if (failed == study_.trials.end()) return;
      const auto index = static_cast<size_t>(failed - study_.trials.begin());
      throw Error(ErrorKind::kNotFound,
                  "no recording could be read; the first fault: " + result_.trials[index].removed +
                      "\nFiles are looked for in \"" + study_.recordings.string() +
                      "\"; --data DIR names another folder" +
                      QuoteComment(study_.file, failed->file));
    }
    Diagnostics problems;
    for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
      const auto i = static_cast<size_t>(digit);
      if (num_missing_[i] == num_read_) {
        problems.Fail(study_.file, study_.marker_lines[digit],
                      std::string("markers.") + NameOfDigit(digit) +
                          ": no recording has it; the first, " + missing_texts_[i]);
      }
    }
    problems.ThrowIfErrors(ErrorKind::kFormat, "the study cannot be analysed");
  }

  const Study& study_;
  const StudyWatch& watch_;
  const UsualHands& usual_;
  StudyResult& result_;
  std::vector<TrialMeasure> measures_;  // that the study tests
  UsualHands hands_;                    // of the trials that count
  PreparedRecording prepared_;
  StudyTables tables_;
  std::string loaded_;  // which recording `prepared_` is
  int num_read_ = 0;
  std::map<int, int> num_parts_;                 // by line of trials.csv
  std::set<int> reviewed_;                       // lines of the reviews
  std::map<std::string, std::string> first_of_;  // trial, by the hash of its thumb's samples
  Diagnostics review_problems_;
  int num_missing_[PerDigit<int>::kNumDigits] = {};
  std::string missing_texts_[PerDigit<int>::kNumDigits];
  std::vector<double> rates_, noises_, cutoffs_;
};

/** Trials of every n-th row of each person, analysed once and with every contact, however uncertain.
@param hands  of those that count. */
StudyResult RunSome(const Study& study, UsualHands& hands) {
  constexpr size_t kMaxRows = 120, kFewestOfPerson = 5;
  StudyResult result;
  result.study = study;
  result.study.config.analysis.contact.max_uncertainty = 0.0;
  result.study.reviews.clear();
  const StudyWatch nobody;
  const UsualHands unknown;
  Runner runner(nobody, unknown, result);
  std::map<std::string, size_t> num_rows;  // of each person
  for (const PlannedReach& planned : study.trials) ++num_rows[planned.participant];
  const size_t most = std::max(kMaxRows, kFewestOfPerson * num_rows.size());
  const size_t step = (study.trials.size() + most - 1) / most;
  num_rows.clear();
  for (const PlannedReach& planned : study.trials) {
    if (num_rows[planned.participant]++ % step == 0) runner.Run(planned);
  }
  runner.CountRates();
  hands = runner.hands();
  return result;
}

}  // namespace

int StudyResult::CountKept() const {
  return static_cast<int>(
      std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.IsKept(); }));
}

Study LeaveOutReport(Study study) {
  study.config.bias_trials = 0;
  study.config.multiverse.is_left_out = true;
  return study;
}

StudyResult RunTrials(const Study& study, const StudyWatch& watch) {
  StudyResult result;
  result.study = study;
  UsualHands hands;
  const StudyResult some = RunSome(study, hands);
  result.study.config = FitCutoffs(study.config, some.highest_rate);  // slower ones lower theirs
  LearnFrom(some.trials, result);
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    if (!study.config.markers.tips[digit].empty()) result.digits.push_back(IdOfDigit(digit));
  }
  result.universes = ListUniverses(result.study.config);
  result.trials.reserve(study.trials.size());
  Runner runner(watch, hands, result);
  for (size_t i = 0; i < study.trials.size(); ++i) {
    runner.Run(study.trials[i]);
    if (watch.on_row) watch.on_row(i + 1, study.trials.size());
  }
  runner.Finish();
  return result;
}

StudyResult RunStudy(const Study& study, const StudyWatch& watch) {
  StudyResult result = RunTrials(study, watch);
  const std::vector<StudyWarning> warnings = FindWarnings(result);
  result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  CalcStudyStatistics(result);
  return result;
}

StudyResult AnalyseStudy(const Study& study, const std::filesystem::path& folder,
                         const std::function<void(size_t, size_t)>& on_row) {
  MotionBidsWriter bids(folder / "bids", study);
  StudyWatch watch;
  watch.on_row = on_row;
  watch.on_trial = [&](const StudyTrial& trial, const ReachTrial& reach) {
    bids.WriteTrial(trial, reach);
  };
  StudyResult result = RunStudy(study, watch);
  bids.Finish();
  WriteStudyTables(result, folder);
  WriteWideTable(result, folder);
  std::vector<MeasureTable> tables;
  for (const TrialMeasure& measure : TrialMeasureList()) {
    tables.push_back(MakeMeasureTable(result, measure));
  }
  SaveTidyExport(tables, folder / "tidy", study.hypotheses);
  WriteFileAtomically(folder / "tidy" / "openings.csv", FormatOpeningTable(result));
  return result;
}

}  // namespace graspbench
