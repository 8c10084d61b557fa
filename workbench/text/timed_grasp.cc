#include "workbench/text/timed_grasp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/data_table.h"
#include "core/base/text/text.h"
#include "core/grasp/grasp_file.h"
#include "core/grasp/grasp_keys.h"
#include "core/hand/load_hand.h"
#include "core/statistics/summary.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

DataTable ReadStudyTable(const fs::path& study, const char* name,
                         const std::vector<std::string>& columns, Diagnostics& problems) {
  const fs::path file = study / name;
  if (!fs::exists(file)) {
    throw Error(ErrorKind::kNotFound, "no " + std::string(name) + " in \"" + study.string() +
                                          "\"; expected the folder of a study, as graspbench "
                                          "study run writes it");
  }
  DataTable table(ReadFile(file), file.string(), problems);
  for (const std::string& column : columns) table.Require(column);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study's tables cannot be read");
  return table;
}

/** Contacts of the trials that count, by trial and digit [s]. */
std::map<std::string, std::map<std::string, double>> ReadContacts(const fs::path& study) {
  Diagnostics problems;
  std::set<std::string> kept;
  const DataTable trials = ReadStudyTable(study, "trials.csv", {"trial_id", "is_kept"}, problems);
  for (size_t row = 0; row < trials.num_rows(); ++row) {
    if (trials.Text(row, "is_kept") == "1") kept.insert(trials.Text(row, "trial_id"));
  }
  DataTable events = ReadStudyTable(
      study, "events.csv", {"trial_id", "event", "digit", "is_believed", "time_s"}, problems);
  std::map<std::string, std::map<std::string, double>> contacts;
  for (size_t row = 0; row < events.num_rows(); ++row) {
    const std::string& trial = events.Text(row, "trial_id");
    if (events.Text(row, "event") != "contact" || events.Text(row, "is_believed") != "1" ||
        kept.count(trial) == 0) {
      continue;
    }
    const double time = events.Number(row, "time_s");
    if (!std::isnan(time)) contacts[trial][events.Text(row, "digit")] = time;
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study's tables cannot be read");
  return contacts;
}

}  // namespace

std::map<std::string, ClosingSchedule> ReadStudyTiming(const fs::path& study,
                                                       const std::vector<std::string>& digits) {
  const auto contacts = ReadContacts(study);
  VerifyStore(study, OnDamage::kRefuse);
  std::set<std::string> known;
  for (const auto& [trial, times] : contacts) {
    for (const auto& [digit, time] : times) known.insert(digit);
  }
  if (known.empty()) {
    throw Error(ErrorKind::kUsage, "the study in \"" + study.string() +
                                       "\" has no contact in a trial that counts; its report says "
                                       "why");
  }
  for (const std::string& digit : digits) {
    if (known.count(digit) > 0) continue;
    throw Error(ErrorKind::kUsage, "the study in \"" + study.string() +
                                       "\" has no contact of the grasp's digit " + digit +
                                       "; it has " + fmt::format("{}", fmt::join(known, ", ")) +
                                       ". Choose a grasp of these digits with --grasp");
  }
  std::map<std::string, std::vector<double>> lags;
  for (const auto& [trial, times] : contacts) {
    const auto has = [&times = times](const std::string& id) { return times.count(id) > 0; };
    if (!std::all_of(digits.begin(), digits.end(), has)) continue;
    double first = HUGE_VAL;
    for (const std::string& digit : digits) first = std::min(first, times.at(digit));
    for (const std::string& digit : digits) lags[digit].push_back(times.at(digit) - first);
  }
  if (lags.empty()) {
    throw Error(ErrorKind::kUsage, "in no trial of the study in \"" + study.string() +
                                       "\" that counts did all digits of the grasp touch: " +
                                       fmt::format("{}", fmt::join(digits, ", ")));
  }
  const double longest = FindFileKey(ListGraspFileKeys(), "closing.DIGIT.delay_s")->high;
  double least = HUGE_VAL;
  for (const auto& [digit, values] : lags) least = std::min(least, CalcMedian(values));
  std::map<std::string, ClosingSchedule> closing;
  for (const auto& [digit, values] : lags) {
    const double delay = CalcMedian(values) - least;
    if (delay > longest) {
      throw Error(ErrorKind::kUsage, digit + " touches " + FormatFixed(delay, 3) +
                                         " s after the others in the study, with which it would "
                                         "stay open for good; a grasp takes at most " +
                                         FormatFixed(longest, 0) +
                                         " s. Are its times in "
                                         "seconds?");
    }
    if (delay > 0.0) closing[digit] = {delay, 1.0};
  }
  return closing;
}

std::string MakeTimedGrasp(const std::string& hand_id, const std::string& grasp_id,
                           const fs::path& study) {
  const Hand hand = LoadHand(hand_id);
  std::vector<std::string> known;
  for (Grasp& grasp : LoadStandardGrasps(hand)) {
    known.push_back(grasp.id);
    if (grasp.id != grasp_id) continue;
    const std::string made_from = grasp.id;
    if (!study.empty()) grasp.closing = ReadStudyTiming(study, grasp.digits);
    grasp.id += study.empty() ? "-new" : "-timed";  // that of a standard grasp is taken
    return FormatGraspFile(hand, grasp, made_from);
  }
  throw Error(ErrorKind::kNotFound, "the " + hand.name + " has no grasp \"" + grasp_id + "\"" +
                                        SuggestNames(grasp_id, known));
}

}  // namespace graspbench
