#include "human_study/recording/importers/c3d_parameters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/base/whole_number.h"
#include "human_study/recording/importers/importer.h"

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

namespace {

std::string UpperCase(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

std::string TrimEnd(std::string_view text) {
  const size_t first_zero = text.find('\0');
  if (first_zero != std::string_view::npos) text = text.substr(0, first_zero);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return std::string(text);
}

bool IsAnyOf(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<size_t> FindCount(double value, double max) {
  const double whole = std::round(value);
  if (!(whole >= 0.0 && whole <= max)) return std::nullopt;
  return ToWhole<size_t>(whole);
}

C3dHead ReadC3dHead(std::istream& stream, const std::string& file) {
  C3dHead head;
  stream.seekg(0, std::ios::end);
  head.file_size = static_cast<uint64_t>(stream.tellg());
  if (head.file_size < kC3dBlock) {
    FailAtByte(file, head.file_size,
               "the file ends here; a C3D header alone has 512 bytes" +
                   std::string(head.file_size == 0 ? " (the file is empty)" : ""));
  }
  const auto read = [&](size_t position, size_t size) {
    std::string bytes(size, '\0');
    stream.seekg(static_cast<std::streamoff>(position));
    stream.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!stream) throw Error(ErrorKind::kIo, "cannot read \"" + file + "\"");
    return bytes;
  };
  head.header = read(0, kC3dBlock);
  if (*head.at(1) != kC3dMark) {
    FailAtByte(file, 1,
               "found " + std::to_string(*head.at(1)) +
                   ", expected 80, the mark of a C3D file; this is another format or damaged");
  }
  const size_t block = *head.at(0);
  head.position = block == 0 ? 0 : (block - 1) * kC3dBlock;
  if (block < 2 || head.position + 4 > head.file_size) {
    FailAtByte(file, 0,
               "the parameter section is said to start at block " + std::to_string(block) +
                   ", which the file of " + std::to_string(head.file_size) +
                   " bytes does not hold");
  }
  // At most 255 blocks by their count, which is one byte and often wrong.
  head.section = read(head.position, static_cast<size_t>(std::min<uint64_t>(
                                         255 * kC3dBlock, head.file_size - head.position)));
  const int processor = static_cast<uint8_t>(head.section[3]);
  if (processor < 84 || processor > 86) {
    FailAtByte(file, head.position + 3,
               "processor type " + std::to_string(processor) +
                   "; expected 84 (Intel), 85 (DEC) or 86 (MIPS)");
  }
  head.processor = static_cast<C3dProcessor>(processor);
  return head;
}

size_t C3dParameter::num_numbers() const {
  return type <= 0 ? 0 : data.size() / static_cast<size_t>(type);
}

double C3dParameter::Number(size_t i) const {
  if (i >= num_numbers()) return std::nan("");
  const auto* p = reinterpret_cast<const uint8_t*>(data.data()) + i * static_cast<size_t>(type);
  if (type == 1) return static_cast<int8_t>(*p);
  if (type == 2) return static_cast<int16_t>(DecodeC3dWord(processor, p));
  return DecodeC3dFloat(processor, p);
}

double C3dParameter::Unsigned(size_t i) const {
  const double value = Number(i);
  if (value >= 0 || type == 4) return value;
  return value + (type == 1 ? 256 : 65536);
}

std::vector<std::string> C3dParameter::Texts() const {
  std::vector<std::string> texts;
  if (type != -1 || data.empty()) return texts;
  const size_t length = dimensions.empty() ? 1 : static_cast<size_t>(dimensions[0]);
  for (size_t at = 0; at + length <= data.size(); at += length) {
    texts.push_back(TrimEnd(data.substr(at, length)));
  }
  return texts;
}

namespace {

/** Reads one record after another of a parameter section. */
class RecordReader {
 public:
  RecordReader(std::string_view section, size_t position, C3dProcessor processor,
               const std::string& file)
      : section_(section), position_(position), processor_(processor), file_(file) {}

  uint8_t Byte(size_t i) const { return static_cast<uint8_t>(section_[i]); }
  size_t Word(size_t i) const {
    return DecodeC3dWord(processor_, reinterpret_cast<const uint8_t*>(&section_[i]));
  }
  /** Fails unless the record at `at` may go on to `end`. */
  void Need(size_t at, size_t end, const char* what) const {
    if (end <= section_.size()) return;
    FailAtByte(file_, position_ + at,
               std::string("a parameter record runs past the end of the parameter section (its ") +
                   what + " would end at byte " + std::to_string(position_ + end) +
                   "); the file is cut off or its parameters are damaged");
  }
  /** The parameter `name` of the record at `at` whose type stands at `cursor`, which then stands
  behind its data. */
  C3dParameter ReadParameter(const std::string& name, size_t at, size_t& cursor) const {
    Need(at, cursor + 2, "type");
    C3dParameter parameter;
    parameter.name = name;
    parameter.processor = processor_;
    // Signed: -1 is text. NOLINTNEXTLINE(bugprone-signed-char-misuse)
    parameter.type = static_cast<int8_t>(Byte(cursor));
    if (!(parameter.type == -1 || parameter.type == 1 || parameter.type == 2 ||
          parameter.type == 4)) {
      FailAtByte(file_, position_ + cursor,
                 "parameter " + name + " has type " + std::to_string(parameter.type) +
                     "; expected -1 (text), 1, 2 or 4");
    }
    const size_t num_dimensions = Byte(cursor + 1);
    cursor += 2;
    Need(at, cursor + num_dimensions, "dimensions");
    size_t size = static_cast<size_t>(std::abs(parameter.type));
    for (size_t i = 0; i < num_dimensions; ++i) {
      parameter.dimensions.push_back(Byte(cursor + i));
      // The product of seven bytes overflows nothing once it is capped at the section's size.
      size = std::min(size * Byte(cursor + i), section_.size() + 1);
    }
    cursor += num_dimensions;
    Need(at, cursor + size, "data");
    parameter.data = section_.substr(cursor, size);
    parameter.position = position_ + cursor;
    cursor += size;
    return parameter;
  }

 private:
  std::string_view section_;
  size_t position_;  // of the section in the file
  C3dProcessor processor_;
  const std::string& file_;
};

}  // namespace

C3dParameters::C3dParameters(std::string_view section, size_t position, C3dProcessor processor,
                             const std::string& file) {
  const RecordReader reader(section, position, processor, file);
  std::map<int, std::string> group_names;
  std::vector<int> group_of;  // by parameter: a group's name may come later
  size_t at = 4;
  while (at + 2 <= section.size()) {
    const auto name_size = static_cast<size_t>(std::abs(static_cast<int8_t>(reader.Byte(at))));
    if (name_size == 0) break;
    // Signed: groups are negative. NOLINTNEXTLINE(bugprone-signed-char-misuse)
    const int id = static_cast<int8_t>(reader.Byte(at + 1));
    size_t cursor = at + 2;
    reader.Need(at, cursor + name_size + 2, "name");
    const std::string name = UpperCase(TrimEnd(section.substr(cursor, name_size)));
    cursor += name_size;
    const size_t distance = reader.Word(cursor);
    size_t next = distance == 0 ? 0 : cursor + distance;
    const size_t swapped = cursor + ((distance & 0xff) << 8 | distance >> 8);
    cursor += 2;
    if (id < 0) {
      group_names[-id] = name;
    } else {
      parameters_.push_back(reader.ReadParameter(name, at, cursor));
      group_of.push_back(id);
    }
    if (next == 0) break;
    // Behind the data stands a description: a byte with its length, then its text.
    const size_t end = cursor < section.size() ? cursor + 1 + reader.Byte(cursor) : cursor;
    if (next != end && (swapped == end || next > section.size())) {
      findings_.push_back({"parameter_pointer", "byte " + std::to_string(position + at),
                           "record " + name + " points to byte " + std::to_string(position + next) +
                               " for the next record; where its own bytes end is taken, byte " +
                               std::to_string(position + end)});
      next = end;
    }
    if (next < cursor) {
      FailAtByte(file, position + at,
                 "record " + name + " points to byte " + std::to_string(position + next) +
                     " for the next record; its own data end at byte " +
                     std::to_string(position + cursor) + " and the section at byte " +
                     std::to_string(position + section.size()));
    }
    at = next;
  }
  for (size_t i = 0; i < parameters_.size(); ++i) {
    const auto found = group_names.find(group_of[i]);
    parameters_[i].group =
        found != group_names.end() ? found->second : "GROUP" + std::to_string(group_of[i]);
  }
}

const C3dParameter* C3dParameters::Find(std::string_view group, std::string_view name) const {
  for (const C3dParameter& parameter : parameters_) {
    if (parameter.group == group && parameter.name == name) return &parameter;
  }
  return nullptr;
}

bool C3dParameters::HasGroup(std::string_view group) const {
  return std::any_of(parameters_.begin(), parameters_.end(),
                     [&](const C3dParameter& parameter) { return parameter.group == group; });
}

std::vector<std::string> C3dParameters::Texts(std::string_view group,
                                              const std::string& name) const {
  std::vector<std::string> all;
  const C3dParameter* parameter = Find(group, name);
  for (int k = 2; parameter != nullptr; ++k) {
    const std::vector<std::string> part = parameter->Texts();
    all.insert(all.end(), part.begin(), part.end());
    parameter = Find(group, name + std::to_string(k));
  }
  return all;
}

std::vector<double> C3dParameters::Numbers(std::string_view group, const std::string& name,
                                           bool is_unsigned) const {
  std::vector<double> all;
  const C3dParameter* parameter = Find(group, name);
  for (int k = 2; parameter != nullptr; ++k) {
    for (size_t i = 0; i < parameter->num_numbers(); ++i) {
      all.push_back(is_unsigned ? parameter->Unsigned(i) : parameter->Number(i));
    }
    parameter = Find(group, name + std::to_string(k));
  }
  return all;
}

std::vector<const C3dParameter*> FindPersonalParameters(const C3dParameters& parameters) {
  std::vector<const C3dParameter*> found;
  for (const C3dParameter& parameter : parameters.all()) {
    const bool is_person = IsAnyOf(parameter.group, {"SUBJECT", "SUBJECTS", "PATIENT"}) ||
                           parameter.name == "SUBJECTS";
    const bool is_date =
        parameter.group == "TRIAL" && (parameter.name.find("DATE") != std::string::npos ||
                                       parameter.name.find("TIME") != std::string::npos);
    if (!is_person && !is_date) continue;
    const std::vector<std::string> texts = parameter.Texts();
    if (std::any_of(texts.begin(), texts.end(), [](const std::string& t) { return !t.empty(); })) {
      found.push_back(&parameter);
    }
  }
  return found;
}

std::vector<PersonalField> RedactC3d(std::string& bytes, const std::string& file) {
  std::istringstream stream(bytes);
  const C3dHead head = ReadC3dHead(stream, file);
  const C3dParameters parameters(head.section, head.position, head.processor, file);
  std::vector<PersonalField> fields;
  std::vector<std::string> prefixes;
  const std::vector<const C3dParameter*> personal = FindPersonalParameters(parameters);
  for (const C3dParameter* parameter : personal) {
    for (const std::string& text : parameter->Texts()) {
      if (text.empty()) continue;
      fields.push_back({parameter->Name(), text});
      if (parameter->group == "SUBJECTS") {
        prefixes.push_back(text.back() == ':' ? text : text + ":");
      }
    }
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(parameter->position),
                parameter->data.size(), ' ');
  }
  // A label keeps its length: the prefix goes, the rest moves forward, blanks follow.
  for (const C3dParameter& parameter : parameters.all()) {
    const bool is_blank = std::find(personal.begin(), personal.end(), &parameter) != personal.end();
    if (is_blank || parameter.type != -1 || parameter.dimensions.empty()) continue;
    const auto length = static_cast<size_t>(parameter.dimensions[0]);
    for (size_t at = 0; length > 0 && at + length <= parameter.data.size(); at += length) {
      const std::string_view entry = parameter.data.substr(at, length);
      for (const std::string& prefix : prefixes) {
        if (entry.substr(0, prefix.size()) != prefix) continue;
        std::string bare(entry.substr(prefix.size()));
        bare.resize(length, ' ');
        bytes.replace(parameter.position + at, length, bare);
        fields.push_back({parameter.Name(), TrimEnd(entry)});
        break;
      }
    }
  }
  return fields;
}

}  // namespace graspbench
