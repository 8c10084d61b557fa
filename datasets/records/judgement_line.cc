#include "datasets/records/judgement_line.h"

#include "core/base/error.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {

std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement) {
  return FormatCheckedLine({{"trial_id", trial_id},
                            {"judge_version", kJudgeVersion},
                            {"judgement", RecordToJson(judgement)}});
}

Judgement ParseJudgementLine(std::string_view line) {
  const Json json = ParseCheckedLine(line);
  try {
    Judgement judgement;
    ReadRecord(json.at("judgement"), judgement);
    return judgement;
  } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
    throw Error(ErrorKind::kFormat, std::string("it is no judgement of this version: ") + e.what());
  }
}

}  // namespace graspbench
