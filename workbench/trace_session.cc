#include "workbench/trace_session.h"

#include <map>
#include <memory>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/session_inputs.h"
#include "objects/catalogue.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

constexpr double kInstantInterval = 0.01;  // finer than the keys of a view [s]

}  // namespace

TrialTracer MakeTrialTracer(const Session& session) {
  using Pair = std::pair<std::string, std::string>;
  struct Bench {
    std::shared_ptr<const GraspObject> object;
    std::unique_ptr<TrialRunner> runner;
  };
  const auto inputs = std::make_shared<const SessionInputs>(
      LoadSessionInputs(session.config, FieldUse::kLater, session.folder));
  const auto benches = std::make_shared<std::map<Pair, Bench>>();
  return [config = session.config, inputs, benches](const PlannedTrial& planned) {
    TrialSetup setup = MakeTrialSetup(config, *inputs, planned);
    Bench& bench = (*benches)[{planned.hand, planned.object}];
    if (!bench.runner) {
      bench.object = CompleteObject(setup.object);
      bench.runner = std::make_unique<TrialRunner>(setup.hand, bench.object);
    }
    setup.object = bench.object;
    return TraceTrial(*bench.runner, setup, kInstantInterval);
  };
}

TrialTracer MakeKeptTracer(const Session& session) {
  const std::filesystem::path page = session.folder / "report" / "index.html";
  if (!std::filesystem::exists(page) || !HasSessionViews(ReadFile(page))) return {};
  try {
    return MakeTrialTracer(session);
  } catch (const Error& fault) {
    PrintMessage("the page loses its 3-D views: " + std::string(fault.what()));
    return {};
  }
}

}  // namespace graspbench
