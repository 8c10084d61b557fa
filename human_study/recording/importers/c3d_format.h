#pragma once
/** @file
Numbers and fixed places of the C3D format (c3d.org, "The C3D File Format" user guide).

A file is a sequence of 512-byte blocks: a header, a chain of named parameters and the data. The
processor type in the parameter section decides the byte order of everything. DEC's floats are VAX
F: the two 16-bit halves are swapped and the exponent is biased two higher than IEEE's. */

#include <cstdint>
#include <cstring>
#include <string>

namespace graspbench {

enum class C3dProcessor : uint8_t { kIntel = 84, kDec = 85, kMips = 86 };

inline constexpr size_t kC3dBlock = 512;
inline constexpr uint8_t kC3dMark = 0x50;  ///< second byte of every C3D file
inline constexpr int kC3dKey = 12345;      ///< header words 148 and 150: a feature is present
inline constexpr int kC3dMaxHeaderEvents = 18;
inline constexpr int kC3dMaxCount = 65535;  ///< the header's counts saturate here

/** Byte offsets of header words; word n stands at byte 2 (n - 1). */
namespace c3d_header {
inline constexpr size_t kPoints = 2, kAnalogPerFrame = 4, kFirstFrame = 6, kLastFrame = 8,
                        kScale = 12, kDataStart = 16, kAnalogSamples = 18, kRate = 20,
                        kLabelRangeKey = 294, kLabelRangeBlock = 296, kEventKey = 298,
                        kEventCount = 300, kEventTimes = 304, kEventLabels = 396;
}  // namespace c3d_header

template <C3dProcessor processor>
uint16_t DecodeC3dWord(const uint8_t* p) {
  return processor == C3dProcessor::kMips ? static_cast<uint16_t>(p[0] << 8 | p[1])
                                          : static_cast<uint16_t>(p[1] << 8 | p[0]);
}

template <C3dProcessor processor>
float DecodeC3dFloat(const uint8_t* p) {
  uint32_t bits;
  float value;
  if constexpr (processor == C3dProcessor::kIntel) {
    bits = p[0] | p[1] << 8 | p[2] << 16 | static_cast<uint32_t>(p[3]) << 24;
  } else if constexpr (processor == C3dProcessor::kMips) {
    bits = p[3] | p[2] << 8 | p[1] << 16 | static_cast<uint32_t>(p[0]) << 24;
  } else {
    bits = p[2] | p[3] << 8 | p[0] << 16 | static_cast<uint32_t>(p[1]) << 24;
    const uint32_t exponent = bits >> 23 & 0xff;
    if (exponent == 0) return 0.0f;
    if (exponent > 2) {
      bits -= 2u << 23;
    } else {  // below IEEE's normal numbers
      std::memcpy(&value, &bits, sizeof value);
      return value / 4.0f;
    }
  }
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

uint16_t DecodeC3dWord(C3dProcessor processor, const uint8_t* p);
float DecodeC3dFloat(C3dProcessor processor, const uint8_t* p);
/** Appends two bytes. */
void AppendC3dWord(std::string& bytes, C3dProcessor processor, uint16_t value);
/** Appends four bytes. @pre `value` is finite; DEC saturates at 1.7e38. */
void AppendC3dFloat(std::string& bytes, C3dProcessor processor, float value);

const char* NameOf(C3dProcessor processor);

}  // namespace graspbench
