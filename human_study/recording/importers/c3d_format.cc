#include "human_study/recording/importers/c3d_format.h"

namespace graspbench {

uint16_t DecodeC3dWord(C3dProcessor processor, const uint8_t* p) {
  return processor == C3dProcessor::kMips ? DecodeC3dWord<C3dProcessor::kMips>(p)
                                          : DecodeC3dWord<C3dProcessor::kIntel>(p);
}

float DecodeC3dFloat(C3dProcessor processor, const uint8_t* p) {
  switch (processor) {
    case C3dProcessor::kIntel:
      return DecodeC3dFloat<C3dProcessor::kIntel>(p);
    case C3dProcessor::kDec:
      return DecodeC3dFloat<C3dProcessor::kDec>(p);
    case C3dProcessor::kMips:
      return DecodeC3dFloat<C3dProcessor::kMips>(p);
  }
  return 0.0f;
}

void AppendC3dWord(std::string& bytes, C3dProcessor processor, uint16_t value) {
  const char low = static_cast<char>(value & 0xff), high = static_cast<char>(value >> 8);
  const bool is_big_endian = processor == C3dProcessor::kMips;
  bytes += is_big_endian ? high : low;
  bytes += is_big_endian ? low : high;
}

void AppendC3dFloat(std::string& bytes, C3dProcessor processor, float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  uint16_t low = bits & 0xffff, high = bits >> 16;
  if (processor == C3dProcessor::kMips) {
    AppendC3dWord(bytes, processor, high);
    AppendC3dWord(bytes, processor, low);
    return;
  }
  if (processor == C3dProcessor::kDec) {
    const uint32_t exponent = bits >> 23 & 0xff;
    if (exponent == 0) {
      bits = 0;  // VAX F has no denormals
    } else if (exponent > 253) {
      bits |= 0x7fffffff;
    } else {
      bits += 2u << 23;
    }
    low = bits & 0xffff;
    high = bits >> 16;
    AppendC3dWord(bytes, processor, high);
    AppendC3dWord(bytes, processor, low);
    return;
  }
  AppendC3dWord(bytes, processor, low);
  AppendC3dWord(bytes, processor, high);
}

const char* NameOf(C3dProcessor processor) {
  switch (processor) {
    case C3dProcessor::kIntel:
      return "Intel";
    case C3dProcessor::kDec:
      return "DEC";
    case C3dProcessor::kMips:
      return "MIPS";
  }
  return "unknown";
}

}  // namespace graspbench
