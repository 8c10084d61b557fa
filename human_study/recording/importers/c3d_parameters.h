#pragma once
/** @file
The parameter section of a C3D file: a chain of groups and named arrays.

Each record holds the distance to the next one. Distances are read as unsigned, so a chain only goes
forward and always ends. Groups may follow their parameters. */

#include <cstdint>
#include <cstring>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "human_study/recording/importers/importer.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** Constants and fixed positions of the C3D format (c3d.org, "The C3D File Format" user guide).

A file is a sequence of 512-byte blocks: a header, a chain of named parameters and the data. The
processor type in the parameter section decides the byte order of everything. DEC's floats are VAX
F: the two 16-bit halves are swapped and the exponent is biased two higher than IEEE's. */
enum class C3dProcessor : uint8_t { kIntel = 84, kDec = 85, kMips = 86 };

inline constexpr size_t kC3dBlock = 512;
inline constexpr uint8_t kC3dMark = 0x50;  ///< second byte of every C3D file
inline constexpr int kC3dKey = 12345;      ///< header words 148 and 150: a feature is present
inline constexpr int kC3dMaxHeaderEvents = 18;
inline constexpr int kC3dMaxCount = 65535;  ///< the header's counts saturate here

/** Byte offsets of header words; word n is at byte 2 (n - 1). */
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
    } else {  // IEEE subnormal numbers
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

/** Converts a number from the file to a count or an index, rounded to the nearest integer; none
when it is NaN, negative or above `max`. Every number from a file that becomes a size passes through
here. */
std::optional<size_t> FindCount(double value, double max);

/** The parts of a file before the data. */
struct C3dHead {
  std::string header;   ///< first block
  std::string section;  ///< parameter section, up to its greatest possible extent
  size_t position = 0;  ///< byte of the section in the file
  uint64_t file_size = 0;
  C3dProcessor processor = C3dProcessor::kIntel;

  const uint8_t* at(size_t byte) const {
    return reinterpret_cast<const uint8_t*>(header.data()) + byte;
  }
  int Word(size_t byte) const { return DecodeC3dWord(processor, at(byte)); }
  double Float(size_t byte) const { return DecodeC3dFloat(processor, at(byte)); }
};

/** @throws Error(kFormat) with the byte position when this is not a C3D file or ends too early. */
C3dHead ReadC3dHead(std::istream& stream, const std::string& file);

struct C3dParameter {
  std::string group;  ///< upper case
  std::string name;   ///< upper case
  int type = 0;       ///< -1 text, 1 byte, 2 word, 4 float
  std::vector<int> dimensions;
  std::string_view data;  ///< bytes inside the section
  size_t position = 0;    ///< byte of `data` in the file
  C3dProcessor processor = C3dProcessor::kIntel;

  std::string Name() const { return group + ":" + name; }
  /** Number of numeric entries; 0 for text. */
  size_t num_numbers() const;
  /** Entry i as signed; NaN out of range or for text. */
  double Number(size_t i = 0) const;
  /** As Number, but words and bytes are unsigned: counts and frame numbers. */
  double Unsigned(size_t i = 0) const;
  /** One string per entry, without trailing blanks and zero bytes. */
  std::vector<std::string> Texts() const;
};

class C3dParameters {
 public:
  /** @param section  the parameter section from its first byte, up to its greatest possible extent
  @param position  its byte position in the file A pointer to the next record is replaced by the
  record's own end if it leaves the section, or if it points past the record once its bytes are
  swapped: some MIPS files store it so.
  @throws Error(kFormat) with the byte at which the chain breaks. */
  C3dParameters(std::string_view section, size_t position, C3dProcessor processor,
                const std::string& file);

  /** Null when absent. */
  const C3dParameter* Find(std::string_view group, std::string_view name) const;
  bool HasGroup(std::string_view group) const;
  /** Concatenated entries of NAME, NAME2, NAME3, ..: arrays of more than 255 entries are split. */
  std::vector<std::string> Texts(std::string_view group, const std::string& name) const;
  std::vector<double> Numbers(std::string_view group, const std::string& name,
                              bool is_unsigned = false) const;
  const std::vector<C3dParameter>& all() const { return parameters_; }
  /** Deviations that were accepted. */
  const std::vector<ImportFinding>& findings() const { return findings_; }

 private:
  std::vector<C3dParameter> parameters_;
  std::vector<ImportFinding> findings_;
};

/** Finds texts that may identify a person or a date: those of SUBJECT, SUBJECTS and PATIENT, of any
parameter called SUBJECTS, and the dates of TRIAL. */
std::vector<const C3dParameter*> FindPersonalParameters(const C3dParameters& parameters);

/** Blanks these texts, and names found in them wherever they prefix a label ("Anna:LTHUMB"). */
std::vector<PersonalField> RedactC3d(std::string& bytes, const std::string& file);

/** Location and size of a C3D file's data, from sources that may contradict each other.

The header, the parameters and the file's size each determine the same counts. The source documents
the rules of choice; each contradiction becomes a finding. */
struct C3dLayout {
  size_t num_points = 0;
  size_t num_channels = 0;
  size_t samples_per_frame = 0;  ///< of each analog channel
  bool is_float = false;
  double scale = 1.0;  ///< length units per integer step; for the residual in every file
  uint64_t data_position = 0;
  size_t num_frames = 0;
  int first_frame = 1;
  double rate = 0.0;  ///< [Hz]; NaN when not stated

  size_t num_analog() const { return num_channels * samples_per_frame; }
  size_t value_size() const { return is_float ? 4 : 2; }
  size_t frame_size() const { return (4 * num_points + num_analog()) * value_size(); }
};

/** Determines the layout, which never extends past the end of the file. Notes go to
`recording.findings`. @throws Error(kFormat), with the byte where the data should continue, when the
file holds fewer frames than every count states and options.accept_truncated is not set. */
C3dLayout FindC3dLayout(const C3dHead& head, const C3dParameters& parameters,
                        const ImportOptions& options, const std::string& file,
                        Recording& recording);

}  // namespace graspbench
