#include "workbench/experiments/board/make_entry.h"

#include "core/base/error.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/scratch_folder.h"

namespace graspbench {

namespace {

std::filesystem::path FindPack(const std::filesystem::path& out) {
  if (out.extension() == ".tar") return out;
  return out / (out.filename().string() + ".tar");
}

}  // namespace

std::filesystem::path MakeEntry(const EntryRequest& request) {
  const std::filesystem::path pack = FindPack(request.out);
  CheckOutputFile(pack);
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
  const ScratchFolder scratch(pack);
  GatherEntry(session, facts, scratch.path() / "entry");
  WritePack(scratch.path() / "entry", pack);
  return pack;
}

}  // namespace graspbench
