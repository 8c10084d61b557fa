#include "datasets/journal/checked_line.h"

#include "core/base/files/files.h"
#include "core/base/hash.h"

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

constexpr std::string_view kSumKey = ",\"xxh64\":\"";
constexpr size_t kSumLength = kSumKey.size() + 16 + 2;  // key, digits, quote and brace

/** Sixteen lower-case digits, as CalcHashHex writes them. */
bool IsHexOf(uint64_t value, std::string_view digits) {
  for (size_t i = digits.size(); i-- > 0; value >>= 4) {
    if (digits[i] != "0123456789abcdef"[value & 15]) return false;
  }
  return true;
}

/** What is wrong with the line, or null. */
const char* FindFault(std::string_view line) {
  const size_t body_length = line.size() - std::min(line.size(), kSumLength);
  const std::string_view body = line.substr(0, body_length), tail = line.substr(body_length);
  if (tail.size() != kSumLength || tail.substr(0, kSumKey.size()) != kSumKey ||
      tail.substr(kSumLength - 2) != "\"}") {
    return "the line is truncated or not a record";
  }
  if (!IsHexOf(CalcHash64(body), tail.substr(kSumKey.size(), 16))) {
    return "its bytes do not match their checksum";
  }
  return nullptr;
}

}  // namespace

std::string DescribeJsonFault(const Json::exception& fault) {
  const std::string text = fault.what();
  if (text.rfind("[json.exception.parse_error", 0) == 0) {
    const std::string place = FindBetween(text, "parse error at ", ":");
    return place.empty() ? "it is not valid JSON" : "it is not valid JSON from " + place + " on";
  }
  const std::string key = FindBetween(text, "key '", "'");
  return key.empty() ? "a value is not of its type" : "its key \"" + key + "\" is missing";
}

std::string FormatCheckedLine(const Json& record) {
  std::string line = FormatJson(record);
  line.pop_back();  // the closing brace comes back behind the checksum
  const std::string sum = CalcHashHex(line);
  return line.append(kSumKey).append(sum).append("\"}");
}

bool IsCheckedLine(std::string_view line) { return !FindFault(line); }

std::string_view FindCheckedBody(std::string_view line) {
  return FindFault(line) ? std::string_view() : line.substr(0, line.size() - kSumLength);
}

Json ParseCheckedLine(std::string_view line) {
  if (const char* fault = FindFault(line)) throw Error(ErrorKind::kFormat, fault);
  try {
    return Json::parse(line);
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                std::string("it is not a record of this version: ") + DescribeJsonFault(e));
  }
}

void ForEachLineOfFile(const std::filesystem::path& path,
                       const std::function<void(const FileLine&)>& take, uintmax_t start) {
  std::string begun;  // of a line that goes on in the next piece
  int number = 0;
  const auto take_piece = [&](std::string_view piece) {
    for (size_t end = piece.find('\n'); end != piece.npos; end = piece.find('\n')) {
      std::string_view text = piece.substr(0, end);
      if (!begun.empty()) text = begun.append(text);
      take({text, ++number, start, true});
      start += text.size() + 1;
      begun.clear();
      piece.remove_prefix(end + 1);
    }
    begun.append(piece);
    return true;
  };
  ReadPieces(path, take_piece, start);
  if (!begun.empty()) take({begun, number + 1, start, false});
}

}  // namespace graspbench
