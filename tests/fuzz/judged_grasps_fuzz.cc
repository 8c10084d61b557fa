// Any bytes as profile.yaml, and as a line of the journal of judged grasps: refused with an Error,
// or what is written back and read again the same.

#include <cstdint>
#include <string>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/judged_grasps/profile_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace graspbench {
namespace {

/** What is read is written, and that must be read as the same. */
template <class Parse, class Format>
void FuzzText(const std::string& text, Parse&& parse, Format&& format) {
  std::string written;
  try {
    written = format(parse(text));
  } catch (const Error&) {
    return;
  }
  const std::string again = format(parse(written));
  GRASPBENCH_DEMAND(again == written, written);
}

}  // namespace
}  // namespace graspbench

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  FuzzText(
      bytes, [](const std::string& text) { return ParseProfile(text, "fuzz.yaml"); },
      [](const FreeSpaceProfile& profile) { return FormatJson(ConfigToJson(profile)); });
  for (const std::string& line : {bytes, bytes + ",\"xxh64\":\"" + CalcHashHex(bytes) + "\"}"}) {
    FuzzText(line, JudgedGrasp::Parse, JudgedGrasp::Format);
  }
  return 0;
}
