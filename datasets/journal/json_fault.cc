#include "datasets/journal/json_fault.h"

namespace graspbench {
namespace {

/** What stands between two marks in the library's message; empty: nothing. */
std::string FindBetween(const std::string& text, const std::string& before,
                        const std::string& after) {
  const size_t begin = text.find(before);
  if (begin == std::string::npos) return {};
  const size_t end = text.find(after, begin + before.size());
  if (end == std::string::npos) return {};
  return text.substr(begin + before.size(), end - begin - before.size());
}

}  // namespace

std::string DescribeJsonFault(const Json::exception& fault) {
  const std::string text = fault.what();
  if (text.rfind("[json.exception.parse_error", 0) == 0) {
    const std::string place = FindBetween(text, "parse error at ", ":");
    return place.empty() ? "it is no JSON" : "it is no JSON from " + place + " on";
  }
  const std::string key = FindBetween(text, "key '", "'");
  return key.empty() ? "a value is not of its type" : "its key \"" + key + "\" is missing";
}

}  // namespace graspbench
