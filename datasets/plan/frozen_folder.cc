#include "datasets/plan/frozen_folder.h"

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/version.h"
#include "core/physics/sim_config.h"
#include "datasets/journal/json_fault.h"
#include "datasets/plan/firm_grip.h"
#include "datasets/plan/model_config.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

std::string FormatSchemas(const StoreKind& kind) {
  if (kind.oldest_schema == kind.schema) return "schema " + std::to_string(kind.schema);
  return "schemas " + std::to_string(kind.oldest_schema) + " to " + std::to_string(kind.schema);
}

/** A manifest of ours: any other file of that name says nothing. */
bool HasManifestOf(const StoreKind& kind, const fs::path& folder) {
  const std::optional<Manifest> manifest = FindManifest(folder);
  return manifest && manifest->kind == kind.name;
}

/** Before there was a `model`, hands and objects were as in their files. */
void AddModel(Json& config) {
  Json& conditions = config.contains("session") ? config["session"] : config;
  if (conditions.contains("sim") && !conditions.contains("model")) {
    conditions["model"] = ConfigToJson(ModelConfig());
  }
}

/** Before physics 10 optimisations and campaigns said nothing of gravity and multibody, and nothing
resisted rolling. What a session lacks is told where it is opened. */
void AddSettingsOfPhysics10(Json& config) {
  Json& conditions = config.contains("session") ? config["session"] : config;
  if (!conditions.contains("sim")) return;
  SimConfig before;
  before.table_rolling_resistance = 0.0;
  const Json known = ConfigToJson(before);
  Json& sim = conditions["sim"];
  for (const char* key : {"gravity_m_per_s2", "table_rolling_resistance_m", "multibody"}) {
    if (!sim.contains(key)) sim[key] = known.at(key);
  }
}

/** Before physics 11 none of them had soft pads, whose stiffness could be scaled. */
void AddSettingsOfPhysics11(Json& config) {
  Json& conditions = config.contains("session") ? config["session"] : config;
  if (!conditions.contains("model")) return;
  Json& scale = conditions["model"]["pad_stiffness_scale"];
  if (scale.is_null()) scale = ConfigToJson(ModelConfig()).at("pad_stiffness_scale");
}

/** Before physics 12 every step had the same length. */
void AddSettingsOfPhysics12(Json& config) {
  Json& conditions = config.contains("session") ? config["session"] : config;
  if (conditions.contains("sim")) conditions["sim"].emplace("steady_step_factor", 1);
}

/** Advice must not lead a new result into a folder that holds something. */
bool MayBegin(const fs::path& folder) {
  std::error_code status;
  return !fs::exists(folder, status) || fs::is_empty(folder, status);
}

}  // namespace

bool HasFrozen(const StoreKind& kind, const fs::path& folder) {
  std::error_code status;
  return fs::exists(folder / kind.file, status);
}

Frozen LoadFrozen(const StoreKind& kind, const fs::path& folder, OnDamage on_damage,
                  const std::vector<std::string>& only) {
  const fs::path path = folder / kind.file;
  if (!HasFrozen(kind, folder) && HasManifestOf(kind, folder)) {
    throw Error(ErrorKind::kFormat, "\"" + path.string() +
                                        "\" is missing, which the manifest beside it names; take "
                                        "it from a backup");
  }
  if (!HasFrozen(kind, folder)) {
    const std::optional<Manifest> other = FindManifest(folder);
    const std::string place = MayBegin(folder) ? folder.string() : "NEW_FOLDER";
    const std::string there =
        other ? "; it holds the result \"" + other->kind + "\")"
              : "); " + std::string(kind.command) + " --out " + place + " starts one";
    throw Error(ErrorKind::kNotFound, std::string("no ") + kind.name + " in \"" + folder.string() +
                                          "\" (" + kind.file + " is not there" + there);
  }
  Frozen frozen;
  try {
    const Json json = Json::parse(ReadFile(path));
    const int schema = IntFrom(json.at("schema"));
    if (schema < kind.oldest_schema || schema > kind.schema) {
      throw Error(ErrorKind::kVersion,
                  "\"" + path.string() + "\" has schema " + std::to_string(schema) +
                      ", this program (" + program_version() + ") reads " + FormatSchemas(kind) +
                      "; use graspbench " + json.value("program_version", "of that time") +
                      " for it, or " + kind.remedy);
    }
    frozen.config = json.value("config", Json::object());
    frozen.physics_version = json.value("physics_version", 0);
    AddModel(frozen.config);
    AddFirmGrip(frozen.config.contains("session") ? frozen.config["session"] : frozen.config);
    if (&kind != &kSessionStore) {
      if (frozen.physics_version < 10) AddSettingsOfPhysics10(frozen.config);
      if (frozen.physics_version < 11) AddSettingsOfPhysics11(frozen.config);
      if (frozen.physics_version < 12) AddSettingsOfPhysics12(frozen.config);
    }
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                "\"" + path.string() + "\" is damaged: " + DescribeJsonFault(e) +
                    "; it is written once and never changed, so take it from a backup");
  }
  StoreState state = VerifyStore(folder, on_damage, only);
  frozen.is_sealed = state.is_sealed;
  frozen.damage = std::move(state.damages);
  if (state.is_made_anew) {
    frozen.damage.push_back(
        {kManifestFile, 0, "was lost and made again: what had changed before is not noticed"});
  }
  return frozen;
}

void WriteFrozen(const StoreKind& kind, const fs::path& folder, const Json& config, int schema) {
  const Json frozen = {{"schema", schema > 0 ? schema : kind.schema},
                       {"program_version", program_version()},
                       {"physics_version", kPhysicsVersion},
                       {"config", config}};
  const std::string text = FormatJson(frozen, 2) + "\n";
  SealNewStore(kind, folder, text);
  WriteFileAtomically(folder / kind.file, text);
}

std::string ListDifferences(const std::vector<std::string>& differences) {
  std::string text;
  for (const std::string& difference : differences) text += "\n  " + difference;
  return text;
}

}  // namespace graspbench
