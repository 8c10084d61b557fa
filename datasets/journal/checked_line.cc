#include "datasets/journal/checked_line.h"

#include <algorithm>

#include "core/base/hash.h"

namespace graspbench {
namespace {

constexpr std::string_view kSumKey = ",\"xxh64\":\"";
constexpr size_t kSumLength = kSumKey.size() + 16 + 2;  // key, digits, quote and brace

}  // namespace

std::string FormatCheckedLine(const Json& record) {
  std::string line = FormatJson(record);
  line.pop_back();  // the closing brace comes back behind the checksum
  const std::string sum = CalcHashHex(line);
  return line.append(kSumKey).append(sum).append("\"}");
}

Json ParseCheckedLine(std::string_view line) {
  const auto fail = [](const std::string& what) { throw Error(ErrorKind::kFormat, what); };
  const size_t body_length = line.size() - std::min(line.size(), kSumLength);
  const std::string_view body = line.substr(0, body_length), tail = line.substr(body_length);
  if (tail.size() != kSumLength || tail.substr(0, kSumKey.size()) != kSumKey ||
      tail.substr(kSumLength - 2) != "\"}") {
    fail("the line is cut off or is no record");
  }
  if (tail.substr(kSumKey.size(), 16) != CalcHashHex(body)) {
    fail("its bytes do not match their checksum");
  }
  try {
    return Json::parse(line);
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat, std::string("it is no record of this version: ") + e.what());
  }
}

}  // namespace graspbench
