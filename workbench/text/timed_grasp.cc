#include "workbench/text/timed_grasp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/grasp_yaml.h"
#include "core/hand/load_hand.h"
#include "core/statistics/summary.h"
#include "core/trial/digit_delays.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_plan.h"
#include "human_study/events/contact_detector.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

DataTable ReadStudyTable(const fs::path& study, const char* name,
                         const std::vector<std::string>& columns, Diagnostics& problems) {
  const fs::path file = study / name;
  if (!fs::exists(file)) {
    throw Error(ErrorKind::kNotFound, "no " + std::string(name) + " in \"" + study.string() +
                                          "\"; expected the result folder of graspbench study run");
  }
  DataTable table(ReadFile(file), file.string(), problems);
  for (const std::string& column : columns) table.Require(column);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study's tables cannot be read");
  return table;
}

}  // namespace

std::vector<TrialTouches> ReadStudyTouches(const fs::path& study) {
  Diagnostics problems;
  std::vector<TrialTouches> kept;
  std::map<std::string, size_t> places;
  const DataTable trials = ReadStudyTable(study, "trials.csv", {"trial_id", "is_kept"}, problems);
  for (size_t row = 0; row < trials.num_rows(); ++row) {
    if (trials.Text(row, "is_kept") != "1") continue;
    places[trials.Text(row, "trial_id")] = kept.size();
    kept.push_back({trials.Text(row, "object"), kUnset, {}});
  }
  DataTable events = ReadStudyTable(
      study, "events.csv", {"trial_id", "event", "digit", "is_believed", "time_s"}, problems);
  for (size_t row = 0; row < events.num_rows(); ++row) {
    const auto place = places.find(events.Text(row, "trial_id"));
    if (events.Text(row, "is_believed") != "1" || place == places.end()) continue;
    TrialTouches& trial = kept[place->second];
    const std::string& event = events.Text(row, "event");
    const double time = events.Number(row, "time_s");
    if (event == "maximum_opening" || event == "last_maximum_opening") trial.start = time;
    if (event != "contact" || IsUnresolved(MissingEvent(events.Text(row, "missing")))) continue;
    const std::string& digit = events.Text(row, "digit");
    trial.contacts.push_back({digit, digit == "TH", time});
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study's tables cannot be read");
  VerifyStore(study, OnDamage::kRefuse);
  return kept;
}

namespace {

/** Of the time between the first and the last contact: by more people's times are lost. */
constexpr double kMostErrorShare = 0.25;

/** By trial and digit [s]. */
std::vector<std::map<std::string, double>> ReadContacts(const fs::path& study) {
  std::vector<std::map<std::string, double>> contacts;
  for (const TrialTouches& trial : ReadStudyTouches(study)) {
    std::map<std::string, double> times;
    for (const DigitContact& contact : trial.contacts) {
      if (!std::isnan(contact.time)) times[std::string(contact.digit)] = contact.time;
    }
    contacts.push_back(std::move(times));
  }
  return contacts;
}

/** In a trial of the default session without variation. */
LaggedClosing FitOnObject(const TimedGraspOptions& options,
                          const std::map<std::string, double>& lags) {
  SessionConfig config;
  config.hands = {options.hand};
  config.objects = {options.object};
  config.grasps = {options.grasp};
  const SessionInputs inputs = LoadSessionInputs(config);
  TrialSetup setup = MakeTrialSetup(config, inputs, MakePlan(config, inputs).front());
  setup.draw = {};
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  TrialRunner runner(setup.hand, setup.object);
  const LaggedClosing found = FitContactLags(runner, setup, lags);
  if (!std::isnan(found.largest_error)) return found;
  throw Error(ErrorKind::kUsage,
              "on the object \"" + options.object + "\" " +
                  (found.untouching.empty() ? "the trial fails numerically"
                                            : "the digit " + found.untouching + " does not touch") +
                  " in a trial without variation, so the order of contacts cannot be reproduced; "
                  "choose another --object or --grasp");
}

/** "golf_ball: FF 0, TH 31 ms after the first, within 0.8 ms in a trial without variation". */
std::string DescribeFit(const std::string& object, const std::map<std::string, double>& lags,
                        const LaggedClosing& found) {
  std::vector<std::string> asked;
  for (const auto& [digit, lag] : lags) {
    asked.push_back(digit + " " + FormatFixed(MsFromS(lag), 0));
  }
  const auto [first, last] = std::minmax_element(
      lags.begin(), lags.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const bool is_lost = found.largest_error > kMostErrorShare * (last->second - first->second);
  return object + ": " + fmt::format("{}", fmt::join(asked, ", ")) +
         " ms after the first, within " + FormatFixed(MsFromS(found.largest_error), 1) +
         " ms in a trial without variation" +
         (is_lost ? ": this grasp cannot reproduce the participants' order and times on this "
                    "object; choose another --object or --grasp"
                  : "");
}

}  // namespace

std::map<std::string, double> ReadStudyLags(const fs::path& study,
                                            const std::vector<std::string>& digits) {
  const auto contacts = ReadContacts(study);
  std::set<std::string> known;
  for (const auto& times : contacts) {
    for (const auto& [digit, time] : times) known.insert(digit);
  }
  if (known.empty()) {
    throw Error(ErrorKind::kUsage,
                "the study in \"" + study.string() +
                    "\" has no contact in an included trial; its report gives the reasons");
  }
  for (const std::string& digit : digits) {
    if (known.count(digit) > 0) continue;
    throw Error(ErrorKind::kUsage, "the study in \"" + study.string() +
                                       "\" has no contact of the grasp's digit " + digit +
                                       "; it has " + fmt::format("{}", fmt::join(known, ", ")) +
                                       ". Choose a grasp of these digits with --grasp");
  }
  std::map<std::string, std::vector<double>> all;
  for (const auto& times : contacts) {
    const auto has = [&times](const std::string& id) { return times.count(id) > 0; };
    if (!std::all_of(digits.begin(), digits.end(), has)) continue;
    double first = HUGE_VAL;
    for (const std::string& digit : digits) first = std::min(first, times.at(digit));
    for (const std::string& digit : digits) all[digit].push_back(times.at(digit) - first);
  }
  if (all.empty()) {
    throw Error(ErrorKind::kUsage, "in no trial of the study in \"" + study.string() +
                                       "\" that is included did all digits of the grasp touch: " +
                                       fmt::format("{}", fmt::join(digits, ", ")));
  }
  const double longest = FindFileKey(ListGraspFileKeys(), "closing.DIGIT.delay_s")->high;
  double least = HUGE_VAL;
  for (const auto& [digit, values] : all) least = std::min(least, CalcMedian(values));
  std::map<std::string, double> lags;
  for (const auto& [digit, values] : all) {
    const double lag = CalcMedian(values) - least;
    if (lag > longest) {
      throw Error(
          ErrorKind::kUsage,
          digit + " touches " + FormatFixed(lag, 3) +
              " s after the others in the study and would never close; a grasp allows at most " +
              FormatFixed(longest, 0) +
              " s. Are its times in "
              "seconds?");
    }
    lags[digit] = lag;
  }
  return lags;
}

TimedGrasp MakeTimedGrasp(const TimedGraspOptions& options) {
  const Hand hand = LoadHand(options.hand);
  std::vector<std::string> known;
  for (Grasp& grasp : LoadStandardGrasps(hand)) {
    known.push_back(grasp.id);
    if (grasp.id != options.grasp) continue;
    const std::string made_from = grasp.id;
    TimedGrasp timed;
    if (!options.study.empty()) {
      const auto lags = ReadStudyLags(options.study, grasp.digits);
      if (options.object.empty()) {
        grasp.closing = DelayBy(lags);
      } else {
        const LaggedClosing found = FitOnObject(options, lags);
        grasp.closing = found.closing;
        timed.summary = DescribeFit(options.object, lags, found);
      }
    }
    grasp.id += options.study.empty() ? "-new" : "-timed";  // that of a standard grasp is taken
    timed.file = FormatGraspFile(hand, grasp, made_from);
    return timed;
  }
  throw Error(ErrorKind::kNotFound, "the " + hand.name + " has no grasp \"" + options.grasp + "\"" +
                                        SuggestNames(options.grasp, known));
}

}  // namespace graspbench
