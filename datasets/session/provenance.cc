#include "datasets/session/provenance.h"

#include "core/base/version.h"
#include "core/physics/sim_config.h"
#include "core/trial/judge/judgement.h"
#include "datasets/journal/store_sources.h"

namespace graspbench {

ManifestOrigin MakeOrigin(const std::string& command) {
  return {command,
          {{"program", program_version()},
           {"commit", program_commit()},
           {"physics", kPhysicsVersion},
           {"judge", kJudgeVersion}},
          {}};
}

ManifestOrigin MakeOutputOrigin(const std::filesystem::path& folder, const std::string& command,
                                const std::vector<std::string>& only) {
  ManifestOrigin origin = MakeOrigin(command);
  const StoreKind* kind = FindStoreKind(folder);
  if (!kind) return origin;
  for (const ManifestSource& source : ListSources(*kind, folder, only)) {
    origin.inputs.push_back({"../" + source.path, source.sha256});
  }
  return origin;
}

}  // namespace graspbench
