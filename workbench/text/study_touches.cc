#include "workbench/text/study_touches.h"

#include <cmath>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/data_table.h"
#include "datasets/journal/sealed_store.h"
#include "human_study/events/contact_detector.h"

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

}  // namespace graspbench
