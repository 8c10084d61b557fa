#include "workbench/experiments/board/make_entry.h"

#include "core/base/error.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/scratch_folder.h"

namespace graspbench {

void MakeEntry(const EntryRequest& request) {
  CheckOutputFile(request.pack);
  EntryFacts facts = request.facts;
  facts.benchmark = request.benchmark.name;
  facts.benchmark_sha256 = request.benchmark.sha256;
  CheckFacts(facts);
  const Session session = LoadSession(request.session, OnDamage::kRefuse, RecordParts::kBrief);
  CheckSettings(request.benchmark, session.config);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, session.folder);
  try {
    CheckEntry(session, inputs, request.benchmark);
  } catch (const Error& fault) {
    throw Error(fault.kind(), "the session in \"" + request.session.string() +
                                  "\" cannot be an entry: " + fault.what());
  }
  const ScratchFolder scratch(request.pack);
  GatherEntry(session, facts, scratch.path() / "entry");
  WritePack(scratch.path() / "entry", request.pack);
}

}  // namespace graspbench
