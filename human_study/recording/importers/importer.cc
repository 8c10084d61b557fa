#include "human_study/recording/importers/importer.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/fence/fence.h"
#include "human_study/recording/importers/cross_recording.h"
#include "human_study/recording/importers/table_mapping.h"

namespace graspbench {
namespace fs = std::filesystem;
namespace {

constexpr size_t kHeadSize = 4096;  // [bytes] by which a format is recognised

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string ReadHead(std::istream& stream) {
  std::string head(kHeadSize, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(0);
  return head;
}

/** Lines that end in a carriage return alone, as programs of the classic Mac OS wrote them. */
bool HasMacLineEnds(std::string_view head) {
  const auto is_text = [](char c) {
    return c == '\t' || c == '\r' || static_cast<uint8_t>(c) >= 32;
  };
  return head.find('\r') != std::string_view::npos &&
         std::all_of(head.begin(), head.end(), is_text);
}

/** Opens a file, with the line ends that the importers know. */
std::unique_ptr<std::istream> OpenLines(const fs::path& path, bool& has_mac_line_ends) {
  std::unique_ptr<std::istream> stream = OpenStream(path);
  has_mac_line_ends = HasMacLineEnds(ReadHead(*stream));
  if (!has_mac_line_ends) return stream;
  std::string bytes = ReadFile(path);
  std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return std::make_unique<std::istringstream>(std::move(bytes));
}

/** True when the text had to be changed. */
bool CleanText(std::string& text) {
  const bool is_utf8 = IsUtf8(text);
  std::string clean;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127) {
      clean += '?';
    } else if (byte < 128 || is_utf8) {
      clean += c;
    } else {  // Latin-1
      clean += static_cast<char>(0xc0 | byte >> 6);
      clean += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  if (clean == text) return false;
  text = std::move(clean);
  return true;
}

void CleanTexts(Recording& recording) {
  size_t num_changed = 0;
  for (RecordedPoint& point : recording.points) {
    num_changed += CleanText(point.label) + CleanText(point.unit);
  }
  for (AnalogChannel& channel : recording.analog) {
    num_changed += CleanText(channel.label) + CleanText(channel.unit);
  }
  for (RecordedEvent& event : recording.events) {
    num_changed += CleanText(event.label) + CleanText(event.context);
  }
  for (ImportFinding& finding : recording.findings) {
    CleanText(finding.where);
    CleanText(finding.text);
  }
  if (num_changed == 0) return;
  recording.Note("text_encoding", "labels",
                 std::to_string(num_changed) +
                     " texts hold control characters or bytes that are not UTF-8; the bytes are "
                     "read as Latin-1, control characters as ?");
  MakeLabelsUnique(recording, "labels");
}

}  // namespace

const std::vector<Importer>& ImporterList() {
  static const std::vector<Importer> list = {
#define GRASPBENCH_IMPORTER(name) Make##name##Importer(),
#include "human_study/recording/importers/importer_list.inc"
#undef GRASPBENCH_IMPORTER
  };
  return list;
}

namespace {

/** By content, else by the end of its name; null when neither shows it. */
const Importer* RecogniseImporter(std::string_view head, const fs::path& path) {
  for (const Importer& importer : ImporterList()) {
    if (importer.recognises != nullptr && importer.recognises(head)) return &importer;
  }
  const std::string name = ToLower(path.filename().string());
  for (const Importer& importer : ImporterList()) {
    for (const std::string& extension : importer.extensions) {
      if (EndsWith(name, extension)) return &importer;
    }
  }
  return nullptr;
}

}  // namespace

const Importer& FindImporter(const std::string& format, std::string_view head,
                             const fs::path& path) {
  if (IsUtf16(head)) {
    throw Error(ErrorKind::kFormat,
                path.string() +
                    ": is UTF-16 (\"Unicode text\" of a spreadsheet); no format of motion "
                    "capture is: save it as UTF-8, or export it again");
  }
  std::vector<std::string> ids;
  for (const Importer& importer : ImporterList()) ids.emplace_back(importer.id);
  if (!format.empty()) {
    for (const Importer& importer : ImporterList()) {
      if (format == importer.id) return importer;
    }
    throw Error(ErrorKind::kNotFound,
                "no recording format \"" + format + "\"" + SuggestNames(format, ids));
  }
  if (const Importer* importer = RecogniseImporter(head, path)) return *importer;
  std::string known;
  for (const std::string& id : ids) known += (known.empty() ? "" : ", ") + id;
  throw Error(ErrorKind::kFormat,
              path.string() + ": " +
                  (head.empty() ? "the file is empty"
                                : "neither its content nor its name shows the format") +
                  "; known formats: " + known +
                  "; a plain table needs the meaning of its columns in a columns.yaml, which "
                  "graspbench new mapping "
                  "FILE proposes (recording.mapping of study.yaml, --mapping of graspbench mocap)");
}

Recording ImportRecording(const Importer& importer, const ImportSource& source,
                          const ImportOptions& options) {
  Recording recording = importer.import(source, options);
  recording.format = importer.id;
  CleanTexts(recording);
  return recording;
}

namespace {

/** A file that the recording's file names, in its folder. */
FindBeside FindSibling(const fs::path& path) {
  return [path](const std::string& name) -> std::optional<fs::path> {
    const fs::path sibling = path.parent_path() / name;
    std::error_code status;
    if (!fs::is_regular_file(sibling, status)) return std::nullopt;
    return sibling;
  };
}

/** One mapping may stand for many recordings of a study: files whose content shows another format
are read by that, unless their heading has the columns that the mapping names. */
std::string ChooseFormat(const ImportOptions& options, std::string_view head,
                         const std::string& name) {
  if (!options.format.empty() || options.mapping.empty()) return options.format;
  const Importer* other = RecogniseImporter(head, name);
  if (other == nullptr) return "table";
  const std::string_view heading = head.substr(0, head.find('\n'));
  return IsHeadingOf(LoadTableMapping(options.mapping), heading) ? "table" : other->id;
}

void ReadRecording(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  ImportOptions options;
  Cross(arguments, options);
  bool has_mac_line_ends = false;
  const std::unique_ptr<std::istream> stream = OpenLines(input.path(), has_mac_line_ends);
  const Importer& importer = FindImporter(ChooseFormat(options, ReadHead(*stream), input.name()),
                                          ReadHead(*stream), input.name());
  Recording recording = ImportRecording(
      importer,
      {*stream, input.name(), [&](const std::string& name) { return input.ReadBeside(name); }},
      options);
  if (has_mac_line_ends) {
    recording.Note("mac_line_ends", "file",
                   "its lines end in a carriage return alone; each is taken as one line");
  }
  Cross(answer, recording);
}

struct Redacted {
  std::string bytes;
  std::vector<PersonalField> fields;
};
template <class Values>
void CrossMembers(Values& values, Redacted& redacted) {
  Cross(values, redacted.bytes, redacted.fields);
}

void ReadRedacted(const FencedInput& input, IncomingValues&, OutgoingValues& answer) {
  Redacted redacted{ReadFile(input.path()), {}};
  const bool has_mac_line_ends =
      HasMacLineEnds(std::string_view(redacted.bytes).substr(0, kHeadSize));
  if (has_mac_line_ends) {
    std::replace(redacted.bytes.begin(), redacted.bytes.end(), '\r', '\n');
  }
  const Importer& importer =
      FindImporter("", std::string_view(redacted.bytes).substr(0, kHeadSize), input.name());
  if (importer.redact == nullptr) {
    throw Error(ErrorKind::kUnsupported, input.name() + ": " + importer.title +
                                             " has no known places for personal data; look at the "
                                             "file yourself before sharing it");
  }
  redacted.fields = importer.redact(redacted.bytes, input.name());
  if (has_mac_line_ends) {
    std::replace(redacted.bytes.begin(), redacted.bytes.end(), '\n', '\r');
  }
  for (PersonalField& field : redacted.fields) CleanText(field.text);
  Cross(answer, redacted);
}

void ReadTableTrials(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  TableMapping mapping;
  Cross(arguments, mapping);
  bool has_mac_line_ends = false;
  std::vector<TableTrial> trials =
      ListTableTrials(*OpenLines(input.path(), has_mac_line_ends), input.name(), mapping);
  Cross(answer, trials);
}

void ReadProposal(const FencedInput& input, IncomingValues&, OutgoingValues& answer) {
  bool has_mac_line_ends = false;
  const std::unique_ptr<std::istream> stream = OpenLines(input.path(), has_mac_line_ends);
  if (const Importer* importer = RecogniseImporter(ReadHead(*stream), input.name())) {
    throw Error(ErrorKind::kUsage, input.name() + ": is read as " + importer->title +
                                       " without a mapping; graspbench mocap info shows it");
  }
  std::string text = FormatProposedMapping(*stream, input.name());
  Cross(answer, text);
}

}  // namespace

std::vector<FencedReader> MakeRecordingReaders() {
  return {{"recording", &ReadRecording},
          {"redacted_recording", &ReadRedacted},
          {"table_trials", &ReadTableTrials},
          {"proposed_mapping", &ReadProposal}};
}

std::string ProposeMapping(const fs::path& table) {
  return Fence::Shared().Read<std::string>("proposed_mapping", FencedFile(table), nullptr,
                                           kReaderSeconds);
}

Recording LoadRecording(const fs::path& path, const ImportOptions& options) {
  return Fence::Shared().Read<Recording>("recording", FencedFile(path), FindSibling(path),
                                         kReaderSeconds, options);
}

std::vector<TableTrial> FindTableTrials(const fs::path& table, const TableMapping& mapping) {
  return Fence::Shared().Read<std::vector<TableTrial>>("table_trials", FencedFile(table), nullptr,
                                                       kReaderSeconds, mapping);
}

std::vector<PersonalField> RedactRecording(const fs::path& in, const fs::path& out) {
  Redacted redacted =
      Fence::Shared().Read<Redacted>("redacted_recording", FencedFile(in), nullptr, kReaderSeconds);
  WriteFileAtomically(out, redacted.bytes);
  return std::move(redacted.fields);
}

}  // namespace graspbench
