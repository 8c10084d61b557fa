#include "workbench/experiments/policies/policy_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/trial/policy/policy_terms.h"

namespace graspbench {
namespace {

constexpr char kScheme[] = "ws://";
constexpr double kMostPixels = 4096;

bool StartsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool IsPolicyFile(const std::string& command) {
  const std::string ending = ".yaml";
  const bool is_word = command.find_first_of(" \t\n;|&<>$`'\"") == command.npos;
  return is_word && command.size() > ending.size() && command.find("://") == command.npos &&
         command.compare(command.size() - ending.size(), ending.size(), ending) == 0;
}

ServerAddress ReadAddress(const std::string& text) {
  const auto fail = [&text](const std::string& what) {
    throw Error(ErrorKind::kUsage, "the address of a policy server \"" + EscapeForTerminal(text) +
                                       "\" " + what + "; expected ws://HOST:PORT/PATH");
  };
  if (!StartsWith(text, kScheme)) fail("does not begin with ws://");
  const std::string rest = text.substr(sizeof kScheme - 1);
  const size_t slash = std::min(rest.find('/'), rest.size());
  std::string host = rest.substr(0, slash);
  ServerAddress address;
  address.path = slash < rest.size() ? rest.substr(slash) : "/";
  address.port = "80";
  const size_t colon = host.rfind(':');
  if (colon != host.npos && host.find(']', colon) == host.npos) {
    address.port = host.substr(colon + 1);
    host.resize(colon);
  }
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  address.host = host;
  const auto is_plain = [](unsigned char c) { return c > ' ' && c < 0x7f; };
  if (host.empty() || host.find_first_of("[]@?#") != host.npos) fail("has no host");
  if (!std::all_of(text.begin(), text.end(), is_plain)) fail("holds blanks or other characters");
  const bool is_port = !address.port.empty() && address.port.size() <= 5 &&
                       address.port.find_first_not_of("0123456789") == address.port.npos;
  if (!is_port || std::stoi(address.port) > 65535) fail("has no port");
  return address;
}

size_t CountIn(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::count(names.begin(), names.end(), name));
}

size_t CountOf(const std::vector<std::string>& columns, const std::vector<std::string>& wanted) {
  return static_cast<size_t>(std::count_if(
      wanted.begin(), wanted.end(), [&](const auto& name) { return CountIn(columns, name) > 0; }));
}

/** @param what  "actions, columns". */
void CheckJoints(const PolicyServer& server, const std::string& what, const Hand& hand,
                 const std::vector<std::string>& names, const std::vector<std::string>& joints) {
  for (const std::string& name : names) {
    if (CountIn(joints, name) > 0) continue;
    throw Error(ErrorKind::kFormat, server.source + ": " + what + ": the hand " + hand.id +
                                        " has no joint \"" + name +
                                        "\" (a file that names joints serves one hand: give "
                                        "--hand, and another file to the other hand)" +
                                        SuggestNames(name, joints));
  }
}

/** A text, or several. */
std::vector<std::string> ReadNames(YamlMap& map, const std::string& key) {
  const YAML::Node node = map.Child(key, Needed::kNo);
  if (!node.IsDefined() || node.IsNull()) return {};
  std::vector<std::string> names;
  if (node.IsScalar()) names = {node.Scalar()};
  for (const auto& item : node) {
    if (node.IsSequence() && item.IsScalar()) names.push_back(item.Scalar());
  }
  if (names.empty() || (node.IsSequence() && names.size() != node.size())) {
    map.Fail(key, "expected a name, or a list of names");
  }
  return names;
}

/** Of observations and facts. */
std::vector<std::string> ListSources() {
  std::vector<std::string> names;
  for (const PolicyObservation& row : ListPolicyObservations()) names.push_back(row.term.name);
  for (const PolicyFact& row : ListPolicyFacts()) names.push_back(row.term.name);
  return names;
}

ServerValue ReadValue(const YAML::Node& node, const std::string& key, const std::string& file,
                      Diagnostics& problems) {
  ServerValue value;
  value.key = key;
  YamlMap map(node, file, "observation, " + key, problems, &ListPolicyServerKeys(), "observation.");
  map.Read("under", value.under, Needed::kNo);
  value.from = ReadNames(map, "from");
  value.joints = ReadNames(map, "joints");
  map.Read("dtype", value.dtype, Needed::kNo);
  map.Read("size", value.size, Needed::kNo);
  map.Read("text", value.text, Needed::kNo);
  if (value.from.empty() == value.text.empty()) map.Fail("", "expected either from or text");
  const std::vector<std::string> known = ListSources();
  for (const std::string& name : value.from) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    map.Fail("from", "no observation or fact \"" + name + "\"" + SuggestNames(name, known));
  }
  const std::vector<std::string> types = {"", "float32", "float64", "uint8"};
  if (std::find(types.begin(), types.end(), value.dtype) == types.end()) {
    map.Fail("dtype", "\"" + value.dtype + "\": expected float32, float64 or uint8");
  }
  if (value.dtype == "uint8" && value.from != std::vector<std::string>{"picture"}) {
    map.Fail("dtype", "uint8 is the type of a picture; expected float32 or float64");
  }
  const bool is_size = std::all_of(value.size.begin(), value.size.end(), [](double pixels) {
    return pixels >= 1.0 && pixels <= kMostPixels && pixels == std::floor(pixels);
  });
  if (!value.size.empty() && (value.size.size() != 2 || !is_size)) {
    map.Fail("size", "expected [height, width] in pixels, 1 to 4096");
  }
  map.FinishKnownKeys();
  return value;
}

void ReadActions(const YAML::Node& node, const std::string& file, Diagnostics& problems,
                 ServerActions& actions) {
  YamlMap map(node, file, "actions", problems, &ListPolicyServerKeys(), "actions.");
  map.Read("key", actions.key, Needed::kNo);
  std::string as = "targets";
  map.Read("as", as, Needed::kNo);
  if (as != "targets" && as != "increments") {
    map.Fail("as", "\"" + as + "\": expected targets or increments");
  }
  actions.are_increments = as == "increments";
  actions.columns = ReadNames(map, "columns");
  for (const std::string& column : actions.columns) {
    if (column != "-" && CountIn(actions.columns, column) > 1) {
      map.Fail("columns", "\"" + column + "\" is listed more than once");
      break;
    }
  }
  const size_t num_pose = CountOf(actions.columns, ListPoseColumns());
  if (num_pose > 0 && num_pose < ListPoseColumns().size()) {
    map.Fail("columns", "a pose of the hand needs all of " +
                            fmt::format("{}", fmt::join(ListPoseColumns(), ", ")));
  }
  if (num_pose > 0 && CountOf(actions.columns, ListTwistColumns()) > 0) {
    map.Fail("columns", "expected a pose of the hand or a twist, not both");
  }
  map.FinishKnownKeys();
}

PolicyServer LoadFile(const std::string& path) {
  PolicyServer server;
  server.source = path;
  server.is_mapped = true;
  Diagnostics problems;
  const YAML::Node root = LoadYaml(path, problems);
  if (root.IsDefined() && !root.IsNull()) {
    YamlMap map(root, path, "policy", problems, &ListPolicyServerKeys());
    std::string address;
    map.Read("server", address);
    try {
      if (!address.empty()) server.address = ReadAddress(address);
    } catch (const Error& error) {
      map.Fail("server", error.what());
    }
    const YAML::Node values = map.Child("observation");
    if (values.IsDefined() && !values.IsMap()) {
      map.Fail("observation", "expected a map of the server's keys");
    } else if (values.IsDefined()) {
      for (const auto& entry : values) {
        const std::string key = entry.first.as<std::string>("");
        ServerValue value = ReadValue(entry.second, key, path, problems);
        const auto is_same = [&](const ServerValue& other) {
          return other.key == value.key && other.under == value.under;
        };
        if (std::any_of(server.observation.begin(), server.observation.end(), is_same)) {
          map.Fail("observation", "the key \"" + key + "\" is listed more than once");
        }
        server.observation.push_back(std::move(value));
      }
    }
    const YAML::Node actions = map.Child("actions", Needed::kNo);
    if (actions.IsDefined() && !actions.IsNull()) {
      ReadActions(actions, path, problems, server.actions);
    }
    map.FinishKnownKeys();
  } else if (problems.num_errors() == 0) {
    problems.Fail(path, 0, "the file is empty");
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the policy file cannot be used");
  return server;
}

}  // namespace

bool IsPolicyServer(const std::string& command) {
  return StartsWith(command, kScheme) || StartsWith(command, "wss://") || IsPolicyFile(command);
}

PolicyServer LoadPolicyServer(const std::string& command) {
  if (IsPolicyFile(command)) return LoadFile(command);
  PolicyServer server;
  server.source = command;
  server.address = ReadAddress(command);
  return server;
}

const std::vector<std::string>& ListPoseColumns() {
  static const std::vector<std::string> columns = {"hand.x",  "hand.y",  "hand.z", "hand.qw",
                                                   "hand.qx", "hand.qy", "hand.qz"};
  return columns;
}

const std::vector<std::string>& ListTwistColumns() {
  static const std::vector<std::string> columns = {"hand.vx", "hand.vy", "hand.vz",
                                                   "hand.wx", "hand.wy", "hand.wz"};
  return columns;
}

void CheckPolicyServer(const PolicyServer& server, const Hand& hand, const PolicyConfig& policy) {
  if (!server.is_mapped) return;
  std::vector<std::string> joints, driven;
  for (const HandJoint& joint : hand.joints) {
    joints.push_back(joint.name);
    if (joint.coupled_to < 0) driven.push_back(joint.name);
  }
  for (const ServerValue& value : server.observation) {
    CheckJoints(server, "observation, " + value.key + ", joints", hand, value.joints, joints);
  }
  const std::vector<std::string>& columns = server.actions.columns;
  std::vector<std::string> known = {"done", "hold", "-"};
  known.insert(known.end(), ListPoseColumns().begin(), ListPoseColumns().end());
  known.insert(known.end(), ListTwistColumns().begin(), ListTwistColumns().end());
  known.insert(known.begin(), driven.begin(), driven.end());
  CheckJoints(server, "actions, columns", hand, columns, known);
  const auto demand = [&](const char* moves, bool is_given, const char* what) {
    if (policy.moves != moves || is_given) return;
    throw Error(ErrorKind::kFormat, server.source + ": actions, columns: policy.moves is " +
                                        policy.moves + ", and no column " + what);
  };
  demand("hand-and-digits",
         CountOf(columns, ListPoseColumns()) + CountOf(columns, ListTwistColumns()) > 0,
         "moves the hand; expected hand.x .. hand.qz or some of hand.vx .. hand.wz");
  demand("digits-until-touch", CountIn(columns, "hold") > 0, "is hold; expected one such column");
}

const FileKeys& ListPolicyServerKeys() {
  static const FileKeys keys = {
      {"server", kRequired, "address of the policy server: ws://HOST:PORT/PATH"},
      {"observation", kRequired, KeyType::kMap,
       "the server's keys, each with the source of its value"},
      {"observation.from", "",
       "observations or facts (manual page controllers), concatenated; or text"},
      {"observation.joints", "", "joints taken from each, in this order; default: all joints"},
      {"observation.dtype", "", "float32 (default), float64 or uint8 (every picture)"},
      {"observation.size", "", KeyType::kNumber,
       "for a picture: height and width in pixels, resized with padding", 1, kMostPixels},
      {"observation.text", "",
       "a text instead, for example a prompt; {object} is replaced by that fact"},
      {"observation.under", "", "key of a map in the server's observation that holds this one"},
      {"actions", "", "location of the actions in the server's answer"},
      {"actions.key", "actions", "key of the rows in the answer"},
      {"actions.as", "targets", "targets or increments"},
      {"actions.columns", "",
       "meaning of each column: a driven joint, hand.x .. hand.qz or hand.vx .. hand.wz (pose or "
       "twist of the hand), done or hold (above 0.5), or - (ignored); default: the driven joints "
       "in their order"},
  };
  return keys;
}

}  // namespace graspbench
