#include "workbench/experiments/pipelines/replay_pack.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "datasets/pipeline/stable_files.h"
#include "datasets/session/ro_crate.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/scratch_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** "differs from line 3 on, byte 120": one-based. */
std::string DescribeFirstByte(const std::string& a, const std::string& b) {
  const auto mismatch = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto byte = mismatch.first - a.begin();
  const auto line = std::count(a.begin(), mismatch.first, '\n') + 1;
  return "differs from byte " + std::to_string(byte + 1) + " on, in line " + std::to_string(line);
}

std::map<std::string, std::string> ListBytes(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    files[name] = SealFile(folder, name).sha256;
  }
  return files;
}

/** In the order of the stages; manifests last: they name what made the others. */
void Compare(const fs::path& packed, const fs::path& made, PackReplay& replay) {
  for (const bool is_of_manifests : {false, true}) {
    for (const std::string& stage : replay.stages) {
      const auto before = ListBytes(packed / stage), now = ListBytes(made / stage);
      std::set<std::string> names;
      for (const auto* files : {&before, &now}) {
        for (const auto& file : *files) names.insert(file.first);
      }
      for (const std::string& name : names) {
        if ((fs::path(name).filename() == kManifestFile) != is_of_manifests) continue;
        ++replay.num_files;
        const bool was = before.count(name) > 0, is = now.count(name) > 0;
        if (was && is && before.at(name) == now.at(name)) continue;
        ++replay.num_different;
        if (replay.first) continue;
        replay.first = {stage + "/" + name, !was ? "is new"
                                            : !is
                                                ? "was not made"
                                                : DescribeFirstByte(ReadFile(packed / stage / name),
                                                                    ReadFile(made / stage / name))};
      }
    }
  }
}

}  // namespace

void MakePack(const Pipeline& pipeline, const fs::path& results, const StageFacts& program,
              const fs::path& pack) {
  CheckOutputFile(pack);
  const PipelineLock lock = LoadPipelineLock(results);
  for (const StageState& state : FindStageStates(pipeline, results, lock, program)) {
    if (state.IsFresh()) continue;
    throw Error(ErrorKind::kUsage, "the stage " + state.stage +
                                       " is stale: " + state.reasons.front() +
                                       "; run graspbench pipeline run first");
  }
  const ScratchFolder scratch(pack);
  const fs::path folder = scratch.path() / "pack";
  const std::string file = std::string(kPackedPipeline) + "/" + pipeline.file.filename().string();
  GatherPack(pipeline, results, MakeOrigin("graspbench pipeline run " + file), folder);
  WritePack(folder, pack);
}

PackReplay ReplayPack(const PackReplayRequest& request, const std::atomic<bool>& stop) {
  if (!request.folder.empty()) CheckOutputFolder({request.folder, "", false, {request.pack}});
  const ScratchFolder scratch(request.folder);
  const fs::path root = request.folder.empty() ? scratch.path() : request.folder;
  const fs::path packed = root / "pack", made = root / "made", kept = scratch.path() / "kept";
  const Manifest manifest = Unpack(request.pack, packed);
  const Pipeline pipeline = LoadPipeline(FindPackedFile(packed, manifest), request.commands);
  PipelineRequest run;
  run.results = made;
  run.program = FindProgramFacts();
  run.num_workers = request.num_workers;
  run.tell = request.tell;
  RunPipeline(pipeline, run, stop);
  PackReplay replay;
  replay.packed_versions = manifest.versions;
  replay.versions = MakeOrigin("").versions;
  for (const PipelineStage& stage : pipeline.stages) {
    replay.stages.push_back(stage.name);
    CopyStableFiles(made / stage.name, kept / stage.name);
    MakeFolder(packed / kPackedResults / stage.name);  // of a stage without a file
  }
  Compare(packed / kPackedResults, kept, replay);
  return replay;
}

}  // namespace graspbench
