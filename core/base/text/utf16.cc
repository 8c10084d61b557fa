#include "core/base/text/utf16.h"

namespace graspbench {

bool IsUtf16(std::string_view bytes) {
  const std::string_view mark = bytes.substr(0, 2);
  if (mark == "\xff\xfe" || mark == "\xfe\xff") return true;
  constexpr size_t kLetters = 4;
  if (bytes.size() < 2 * kLetters) return false;
  for (const size_t zero : {0, 1}) {
    bool alternates = true;
    for (size_t i = 0; i < 2 * kLetters; ++i) {
      alternates = alternates && (i % 2 == zero ? bytes[i] == '\0' : bytes[i] >= ' ');
    }
    if (alternates) return true;
  }
  return false;
}

}  // namespace graspbench
