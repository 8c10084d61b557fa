#include "workbench/experiments/map_basin.h"

#include "core/base/error.h"
#include "datasets/plan/input_copies.h"
#include "datasets/plan/session_inputs.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

SessionConfig MakeBasinConfig(const BasinRequest& request) {
  SessionConfig config;
  config.hands = {request.hand};
  config.objects = {request.object};
  config.grasps = {request.grasp};
  config.trials = 1;
  config.draws = "halton";
  config.variation.offset = kBasinOffset;
  config.variation.yaw = kBasinYaw;
  return config;
}

/** A basin is a session of such draws; another session is no result of this command. */
std::string FindKindToReplace(const fs::path& folder) {
  const bool is_other = HasSession(folder) && LoadPlannedSession(folder).config.draws != "halton";
  return is_other ? "basin" : kSessionStore.name;
}

}  // namespace

PreparedSession PrepareBasin(const BasinRequest& request) {
  const std::vector<fs::path> read = {request.hand, request.object, request.grasp};
  const bool is_there = HasSession(request.out);
  OutputRequest output = {request.out, FindKindToReplace(request.out), request.replace, read};
  if (!is_there) CheckOutputFolder(output);  // before anything is read
  SessionConfig config = MakeBasinConfig(request);
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
  if (const size_t num_cells = MakePlan(config, inputs).size(); num_cells != 1) {
    throw Error(ErrorKind::kUsage,
                "found " + std::to_string(num_cells) +
                    " conditions; a basin is that of one hand, one object and one "
                    "grasp");
  }
  config.trials = request.num_samples;
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  if (!is_there || !(LoadPlannedSession(request.out).plan == plan)) {
    if (is_there) output.derived = ListStoreFiles(request.out);
    StagedFolder staged(output, StagedFolder::Mark::kOwn);
    CopyInputs(config, staged.path());
    CreateSession(staged.path(), config, plan);
    staged.Commit();
  }
  SessionRequest session;
  session.config = config;
  session.out = request.out;
  session.resume = true;
  session.inputs = read;
  return PrepareSession(session);
}

}  // namespace graspbench
