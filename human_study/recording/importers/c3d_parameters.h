#pragma once
/** @file
The parameter section of a C3D file: a chain of groups and named arrays.

Each record holds the distance to the next one. Distances are read as unsigned, so a chain can only
go forward and always ends. Groups may come after their parameters. */

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "human_study/recording/importers/c3d_format.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** A number of the file as a count or an index, rounded to the next whole one; none when it is not a
number, negative or above `max`. Every foreign number becomes a size through here. */
std::optional<size_t> FindCount(double value, double max);

/** What stands before the data. */
struct C3dHead {
  std::string header;   ///< first block
  std::string section;  ///< parameter section, as far as it can reach
  size_t position = 0;  ///< byte of the section in the file
  uint64_t file_size = 0;
  C3dProcessor processor = C3dProcessor::kIntel;

  const uint8_t* at(size_t byte) const {
    return reinterpret_cast<const uint8_t*>(header.data()) + byte;
  }
  int Word(size_t byte) const { return DecodeC3dWord(processor, at(byte)); }
  double Float(size_t byte) const { return DecodeC3dFloat(processor, at(byte)); }
};

/** @throws Error(kFormat) with the byte when this is not a C3D file or ends too early. */
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
  /** Numbers it holds; texts count as none. */
  size_t num_numbers() const;
  /** Signed; NaN outside or for texts. */
  double Number(size_t i = 0) const;
  /** As Number, but words and bytes are unsigned: counts and frame numbers. */
  double Unsigned(size_t i = 0) const;
  /** One string per entry, without trailing blanks and zeros. */
  std::vector<std::string> Texts() const;
};

class C3dParameters {
 public:
  /** @param section   the parameter section from its first byte, as far as it can reach
  @param position  its place in the file
  A pointer to the next record that leaves the section, or that points behind the record once its
  bytes are swapped, is taken to mean the record's own end: some MIPS files store one so.
  @throws Error(kFormat) with the byte at which the chain breaks. */
  C3dParameters(std::string_view section, size_t position, C3dProcessor processor,
                const std::string& file);

  /** Null when absent. */
  const C3dParameter* Find(std::string_view group, std::string_view name) const;
  bool HasGroup(std::string_view group) const;
  /** Entries of NAME, NAME2, NAME3, .. in a row: arrays of more than 255 entries are split. */
  std::vector<std::string> Texts(std::string_view group, const std::string& name) const;
  std::vector<double> Numbers(std::string_view group, const std::string& name,
                              bool is_unsigned = false) const;
  const std::vector<C3dParameter>& all() const { return parameters_; }
  /** What was accepted. */
  const std::vector<ImportFinding>& findings() const { return findings_; }

 private:
  std::vector<C3dParameter> parameters_;
  std::vector<ImportFinding> findings_;
};

/** Texts that name a person or a day: those of SUBJECT, SUBJECTS and PATIENT, of any parameter
called SUBJECTS, and the dates of TRIAL. */
std::vector<const C3dParameter*> FindPersonalParameters(const C3dParameters& parameters);

/** Blanks those texts, and the names found there wherever they prefix a label ("Anna:LTHUMB"). */
std::vector<PersonalField> RedactC3d(std::string& bytes, const std::string& file);

}  // namespace graspbench
