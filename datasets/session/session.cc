#include "datasets/session/session.h"

#include "core/base/error.h"
#include "datasets/records/judgement_line.h"

namespace graspbench {

TrialRecord LoadWhole(const Session& session, const TrialRecord& record) {
  const RecordLines& lines = session.lines;
  if (lines.trials.empty()) return record;
  const auto index = static_cast<size_t>(&record - session.records.data());
  GRASPBENCH_DEMAND(index < session.records.size(), record.plan.id);
  LinePlace place = lines.trials[index];
  try {
    TrialRecord whole = ParseJournalLine(ReadLine(lines, place));
    if (!(whole.plan == record.plan)) throw Error(ErrorKind::kFormat, "it is another trial's");
    place = lines.judgements[index];
    if (place.file >= 0) whole.judgement = ParseJudgementLine(ReadLine(lines, place));
    return whole;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kFormat) throw;
    throw Error(ErrorKind::kFormat, NameOfLine(lines, place) +
                                        " has changed since the session was loaded: " + e.what() +
                                        "; let nobody else write there and start again");
  }
}

std::string DescribeForeign(const std::string& trial_id) {
  return "trial " + trial_id + " is not in the plan: the line is another session's";
}

}  // namespace graspbench
