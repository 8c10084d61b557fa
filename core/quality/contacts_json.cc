#include "core/quality/contacts_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {
namespace {

/** Puts null for NaN and the infinities outside strings, so that the reader can say whose number it
is. */
std::string ReplaceNonNumbers(std::string_view text) {
  std::string replaced;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (!in_string) {
      bool found = false;
      for (const std::string_view word : {"NaN", "-Infinity", "Infinity"}) {
        if (text.substr(i, word.size()) == word) {
          replaced += "null";
          i += word.size() - 1;
          found = true;
          break;
        }
      }
      if (found) continue;
    }
    if (text[i] == '"') in_string = !in_string;
    replaced += text[i];
    if (in_string && text[i] == '\\' && i + 1 < text.size()) replaced += text[++i];
  }
  return replaced;
}

/** One JSON object; notes every key asked for, to report the others. */
class ObjectReader {
 public:
  ObjectReader(const Json& json, std::string prefix, const std::string& file,
               Diagnostics& diagnostics)
      : json_(json), prefix_(std::move(prefix)), file_(file), diagnostics_(diagnostics) {}

  /** The key's value; null if it is missing, after a complaint if it is needed. */
  const Json* Find(const std::string& key, bool is_needed) {
    known_.push_back(key);
    if (const Json* const found = json_.find(key)) return found;
    if (is_needed) Fail("the key \"" + key + "\" is missing");
    return nullptr;
  }
  std::optional<double> FindNumber(const std::string& key, bool is_needed) {
    const Json* const json = Find(key, is_needed);
    if (json == nullptr) return std::nullopt;
    if (IsNumber(*json)) return json->get<double>();
    Fail(key + ": expected a finite number");
    return std::nullopt;
  }
  std::optional<Eigen::Vector3d> FindVector(const std::string& key, bool is_needed) {
    const Json* const json = Find(key, is_needed);
    if (json == nullptr) return std::nullopt;
    if (json->is_array() && json->size() == 3 &&
        std::all_of(json->begin(), json->end(), IsNumber)) {
      return VectorFrom(*json);
    }
    Fail(key + ": expected three finite numbers in brackets");
    return std::nullopt;
  }
  void FinishKnownKeys() {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
        Fail("unknown key \"" + key + "\"" + SuggestNames(key, known_));
      }
    }
  }
  void Fail(const std::string& problem) { diagnostics_.Fail(file_, 0, prefix_ + problem); }

 private:
  static bool IsNumber(const Json& json) {
    return json.is_number() && std::isfinite(json.get<double>());
  }

  const Json& json_;
  std::string prefix_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
};

GraspContact ReadContact(ObjectReader& reader) {
  const Eigen::Vector3d unset = Eigen::Vector3d::Zero();
  GraspContact contact;
  contact.p_OC = reader.FindVector("p_m", true).value_or(unset);
  contact.nhat_O = reader.FindVector("n", true).value_or(unset);
  contact.mu = reader.FindNumber("mu", true).value_or(0.0);
  contact.torsion = reader.FindNumber("torsion_m", false).value_or(0.0);
  contact.first_edge_O = reader.FindVector("t", false);
  reader.FinishKnownKeys();
  return contact;
}

}  // namespace

QualityRequest ParseQualityRequest(std::string_view text, const std::string& file) {
  const std::string headline = file + " is not a usable set of contacts:";
  Json json;
  try {
    json = Json::parse(ReplaceNonNumbers(text));
  } catch (const Json::exception& error) {
    const std::string reason = error.what();  // "[json.exception...] parse error at line 1, ..."
    throw Error(ErrorKind::kFormat,
                file + " is not valid JSON: " + reason.substr(reason.find("] ") + 2));
  }
  if (!json.is_object()) {
    throw Error(ErrorKind::kFormat, file + ": expected an object {\"contacts\": [...], ...}");
  }

  Diagnostics diagnostics;
  QualityRequest request;
  ObjectReader reader(json, "", file, diagnostics);
  if (const Json* contacts = reader.Find("contacts", true)) {
    if (!contacts->is_array()) reader.Fail("contacts: expected a list in brackets");
    for (size_t i = 0; contacts->is_array() && i < contacts->size(); ++i) {
      const std::string prefix = "contacts[" + std::to_string(i) + "]: ";
      if (!(*contacts)[i].is_object()) {
        reader.Fail(prefix + "expected an object with the keys p_m, n, mu");
        continue;
      }
      ObjectReader contact_reader((*contacts)[i], prefix, file, diagnostics);
      request.contacts.push_back(ReadContact(contact_reader));
    }
  }
  if (const std::optional<double> edges = reader.FindNumber("edges", false)) {
    if (*edges == std::floor(*edges) && std::abs(*edges) < 1e6) {
      request.num_edges = static_cast<int>(*edges);
    } else {
      reader.Fail("edges: expected a whole number");
    }
  }
  request.torque_scale = reader.FindNumber("torque_scale_m", false);
  request.p_OR = reader.FindVector("reference_m", false).value_or(request.p_OR);
  if (const Json* convention = reader.Find("convention", false)) {
    try {
      request.convention =
          FindQualityConvention(convention->is_string() ? convention->get<std::string>() : "");
    } catch (const Error& error) {
      reader.Fail(std::string("convention: ") + error.what());
    }
  }
  reader.FinishKnownKeys();
  diagnostics.ThrowIfErrors(ErrorKind::kFormat, headline);

  for (const std::string& problem : ListProblems(request)) diagnostics.Fail(file, 0, problem);
  diagnostics.ThrowIfErrors(ErrorKind::kFormat, headline);
  return request;
}

}  // namespace graspbench
