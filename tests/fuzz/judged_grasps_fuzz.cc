// Any bytes as profile.yaml, and as a line of the journal of judged grasps: refused with an Error,
// or what is written back and read again the same.

#include <string>

#include "core/base/config.h"
#include "core/base/hash.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/judged_grasps/profile_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  FuzzRoundTrip(
      bytes, [](const std::string& text) { return ParseProfile(text, "fuzz.yaml"); },
      [](const FreeSpaceProfile& profile) { return FormatJson(ConfigToJson(profile)); });
  for (const std::string& line : {bytes, bytes + ",\"xxh64\":\"" + CalcHashHex(bytes) + "\"}"}) {
    FuzzRoundTrip(line, JudgedGrasp::Parse, JudgedGrasp::Format);
  }
}

}  // namespace graspbench
