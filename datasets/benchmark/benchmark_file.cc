#include "datasets/benchmark/benchmark_file.h"

#include <algorithm>
#include <filesystem>

#include "core/arm/load_arm.h"
#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/physics/sim_config.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr size_t kCommitmentDigits = 64;

const std::string* FindPin(const BenchmarkPins& pins, const std::string& id) {
  for (const auto& [name, hash] : pins) {
    if (name == id) return &hash;
  }
  return nullptr;
}

std::vector<std::string> ListPinned(const BenchmarkPins& pins) {
  std::vector<std::string> names;
  for (const auto& pin : pins) names.push_back(pin.first);
  return names;
}

bool IsHex(const std::string& text, size_t size) {
  return text.size() == size && text.find_first_not_of("0123456789abcdef") == text.npos;
}

BenchmarkPins ReadPins(YamlMap& map, const std::string& key) {
  BenchmarkPins pins;
  const YAML::Node node = map.Child(key);
  if (!node.IsDefined() || node.IsNull()) return pins;
  if (!node.IsMap()) {
    map.Fail(key, "expected a map of ids, each with the hash of its content");
    return pins;
  }
  for (const auto& item : node) {
    const std::string id = item.first.IsScalar() ? item.first.Scalar() : "";
    const std::string hash = item.second.IsScalar() ? item.second.Scalar() : "";
    if (id.empty() || !IsHex(hash, 16) || FindPin(pins, id)) {
      map.Fail(key, "\"" + id + "\": expected each id once, with 16 hexadecimal digits");
    } else {
      pins.emplace_back(id, hash);
    }
  }
  return pins;
}

/** The session, and whether the keys that an entry may choose are some of a session. */
void ReadSession(YamlMap& map, const std::string& file, Benchmark& benchmark,
                 Diagnostics& problems) {
  const YAML::Node node = map.Child("session", Needed::kNo);
  ReadConfig(node, file, "session", benchmark.session, problems);
  benchmark.session.objects = ListPinned(benchmark.objects);
  for (const ConfigProblem& problem : Validate(benchmark.session)) {
    map.Fail("session", problem.key + ": " + problem.text);
  }
  for (const std::string& hand : benchmark.session.hands) {
    if (!FindPin(benchmark.hands, hand)) {
      map.Fail("session", "hands: \"" + hand + "\" is not among the benchmark's hands");
    }
  }
  const std::vector<std::string> keys = ListConfigKeys(benchmark.session);
  for (const std::string& open : benchmark.open) {
    if (std::find(keys.begin(), keys.end(), open) == keys.end()) {
      map.Fail("open", "no setting \"" + open + "\"" + SuggestNames(open, keys));
    }
  }
}

Json ToJson(const BenchmarkPins& pins) {
  Json json = Json::object();
  for (const auto& [id, hash] : pins) json[id] = hash;
  return json;
}

std::string CalcBenchmarkSha256(const Benchmark& benchmark) {
  return CalcSha256(FormatJson({{"name", benchmark.name},
                                {"physics", benchmark.physics},
                                {"session", ConfigToJson(benchmark.session)},
                                {"open", benchmark.open},
                                {"hands", ToJson(benchmark.hands)},
                                {"objects", ToJson(benchmark.objects)},
                                {"commitment", benchmark.commitment}}));
}

/** @param key  "sim.step_s: 0.002 and 0.001", as FindConfigDifferences says it. */
bool IsOpen(const Benchmark& benchmark, const std::string& difference) {
  const std::string key = difference.substr(0, difference.find(':'));
  return key == "hands" ||
         std::find(benchmark.open.begin(), benchmark.open.end(), key) != benchmark.open.end();
}

fs::path FindFolder() { return FindDataRoot() / "datasets" / "benchmarks"; }

/** Empty: it is the pinned one. */
std::string FindOther(const BenchmarkPins& pins, const char* what, const std::string& id,
                      const std::string& hash) {
  const std::string* pinned = FindPin(pins, id);
  if (pinned && *pinned == hash) return "";
  return std::string("\n  ") + what + " " + id + ": hash " + hash + " here, " +
         (pinned ? "pinned " + *pinned : "not one of the benchmark's");
}

/** With all its hands, and grasps that cost nothing. */
SessionConfig MakeWhole(const Benchmark& benchmark) {
  SessionConfig all = benchmark.session;
  all.hands = ListPinned(benchmark.hands);
  all.grasps = {kPredictedGrasp};
  return all;
}

}  // namespace

const FileKeys& ListBenchmarkKeys() {
  static const FileKeys keys = {
      {"name", kRequired, "what people call it, with its version: graspbench-21/1"},
      {"about", "", "what it is for, in a sentence"},
      {"physics", kRequired, "version of the physics, as physics_version of session.json has it", 1,
       1e6},
      {"open", "", "settings of session.yaml that an entry may choose, beside its hands"},
      {"commitment", "", "of held-out draws: SHA-256 of \"NAME SEED NONCE\""},
      {"hands", kRequired, KeyType::kMap, "a map: hands that an entry may choose, and their hash"},
      {"objects", kRequired, KeyType::kMap,
       "a map: objects that every entry grasps, and their "
       "hash"},
      {"session", "", KeyType::kMap, "keys of session.yaml: protocol, draws, rules of success"},
  };
  return keys;
}

Benchmark ParseBenchmark(const std::string& text, const std::string& file) {
  Diagnostics problems;
  Benchmark benchmark;
  const YAML::Node root = ParseYaml(text, file, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the benchmark cannot be used");
  YamlMap map(root, file, "benchmark", problems, &ListBenchmarkKeys());
  map.Read("name", benchmark.name);
  map.Read("about", benchmark.about, Needed::kNo);
  map.Read("physics", benchmark.physics);
  map.Read("open", benchmark.open, Needed::kNo);
  map.Read("commitment", benchmark.commitment, Needed::kNo);
  benchmark.hands = ReadPins(map, "hands");
  benchmark.objects = ReadPins(map, "objects");
  ReadSession(map, file, benchmark, problems);
  map.FinishKnownKeys();
  benchmark.commitment = ToLower(benchmark.commitment);
  if (!benchmark.commitment.empty() && !IsHex(benchmark.commitment, kCommitmentDigits)) {
    map.Fail("commitment", "expected 64 hexadecimal digits");
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the benchmark cannot be used");
  benchmark.sha256 = CalcBenchmarkSha256(benchmark);
  return benchmark;
}

std::string NameBenchmarkFile(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

std::vector<std::string> ListBenchmarks() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(FindFolder(), none)) {
    if (entry.path().extension() != ".yaml") continue;
    std::string name = entry.path().stem().string();  // as its name has it, but for the slash
    if (const size_t last = name.rfind('-'); last != name.npos) name[last] = '/';
    names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Benchmark LoadBenchmark(const std::string& name) {
  std::error_code status;
  if (fs::is_regular_file(name, status)) return ParseBenchmark(ReadFile(name), name);
  const fs::path shipped = FindFolder() / (NameBenchmarkFile(name) + ".yaml");
  if (!fs::is_regular_file(shipped, status)) {
    throw Error(ErrorKind::kNotFound,
                "no benchmark and no file \"" + name + "\"" + SuggestNames(name, ListBenchmarks()));
  }
  return ParseBenchmark(ReadFile(shipped), shipped.string());
}

void CheckPins(const Benchmark& benchmark, const SessionInputs& inputs) {
  if (benchmark.physics != kPhysicsVersion) {
    throw Error(ErrorKind::kVersion,
                benchmark.name + " is of physics version " + std::to_string(benchmark.physics) +
                    "; this program has version " + std::to_string(kPhysicsVersion) +
                    ": use the program that the benchmark was released with");
  }
  std::string others;
  for (const SessionHand& hand : inputs.hands) {
    others += FindOther(benchmark.hands, "hand", hand.hand->id, hand.hand->content_hash);
  }
  for (const auto& object : inputs.objects) {
    others += FindOther(benchmark.objects, "object", object->id, object->content_hash);
  }
  if (others.empty()) return;
  throw Error(ErrorKind::kVersion, "hands or objects of this program are not those of " +
                                       benchmark.name + others +
                                       "\nUse the program that the benchmark was released with");
}

SessionInputs LoadPinned(const Benchmark& benchmark) {
  SessionInputs inputs = LoadSessionInputs(MakeWhole(benchmark), FieldUse::kLater);
  CheckPins(benchmark, inputs);
  return inputs;
}

SessionConfig MakeHeldOut(SessionConfig config, int seed) {
  config.seed = seed;
  for (std::string& object : config.objects) object = ChangeSyntheticSeed(object, seed);
  return config;
}

SessionInputs LoadHeldOut(const Benchmark& benchmark, int seed) {
  return LoadSessionInputs(MakeHeldOut(MakeWhole(benchmark), seed), FieldUse::kLater);
}

std::vector<std::string> FindOtherSettings(const Benchmark& benchmark,
                                           const SessionConfig& config) {
  std::vector<std::string> others;
  for (const std::string& hand : config.hands) {
    if (!FindPin(benchmark.hands, hand)) {
      others.push_back("hands: \"" + hand + "\"" + SuggestNames(hand, ListPinned(benchmark.hands)));
    }
  }
  for (std::string& difference : FindConfigDifferences(benchmark.session, config)) {
    if (!IsOpen(benchmark, difference)) others.push_back(std::move(difference));
  }
  if (config.draws != benchmark.session.draws) others.push_back("draws: " + config.draws);
  const std::vector<std::string> arms = ListArms();
  const std::string& arm = config.arm.model;
  if (HasArm(config.arm) && std::find(arms.begin(), arms.end(), arm) == arms.end()) {
    others.push_back("arm.model: \"" + arm + "\"" + SuggestNames(arm, arms));
  }
  if (!config.conditions.empty()) others.push_back("conditions: a sweep");
  return others;
}

void CheckSettings(const Benchmark& benchmark, const SessionConfig& config) {
  std::string text;
  for (const std::string& other : FindOtherSettings(benchmark, config)) text += "\n  " + other;
  if (text.empty()) return;
  throw Error(ErrorKind::kUsage,
              "not as " + benchmark.name + " has it, of the benchmark and here:" + text +
                  "\nAn entry may choose its hands and what the benchmark's file lists as open");
}

std::string ReadCommitment(const std::string& text) {
  std::string commitment = ToLower(text);
  if (IsHex(commitment, kCommitmentDigits)) return commitment;
  throw Error(ErrorKind::kUsage,
              "the commitment \"" + text + "\" is no SHA-256; expected 64 hexadecimal digits");
}

std::string CalcCommitment(const std::string& benchmark, int seed, const std::string& nonce) {
  return CalcSha256(benchmark + " " + std::to_string(seed) + " " + nonce);
}

}  // namespace graspbench
