#include "human_study/recording/importers/importer.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/fence/fence.h"
#include "human_study/recording/importers/cross_recording.h"

namespace graspbench {
namespace fs = std::filesystem;
namespace {

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string ReadHead(std::istream& stream) {
  std::string head(4096, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(0);
  return head;
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
  const std::string name = ToLower(path.filename().string());
  const auto has_extension = [&](const Importer& importer) {
    return std::any_of(importer.extensions.begin(), importer.extensions.end(),
                       [&](const std::string& extension) { return EndsWith(name, extension); });
  };
  for (const Importer& importer : ImporterList()) {
    if (importer.recognises != nullptr && importer.recognises(head)) return importer;
  }
  for (const Importer& importer : ImporterList()) {
    if (has_extension(importer)) return importer;
  }
  std::string known;
  for (const std::string& id : ids) known += (known.empty() ? "" : ", ") + id;
  throw Error(ErrorKind::kFormat,
              path.string() + ": " +
                  (head.empty() ? "the file is empty"
                                : "neither its content nor its name shows the format") +
                  "; known formats: " + known +
                  " (--format names one; a plain table needs --mapping columns.yaml)");
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

void ReadRecording(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  ImportOptions options;
  Cross(arguments, options);
  const std::unique_ptr<std::istream> stream = OpenStream(input.path());
  // A mapping is only of use to the plain table.
  const std::string format =
      options.format.empty() && !options.mapping.empty() ? "table" : options.format;
  const Importer& importer = FindImporter(format, ReadHead(*stream), input.name());
  Recording recording = ImportRecording(
      importer,
      {*stream, input.name(), [&](const std::string& name) { return input.ReadBeside(name); }},
      options);
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
  const Importer& importer =
      FindImporter("", std::string_view(redacted.bytes).substr(0, 4096), input.name());
  if (importer.redact == nullptr) {
    throw Error(ErrorKind::kUnsupported, input.name() + ": " + importer.title +
                                             " has no known places for personal data; look at the "
                                             "file yourself before sharing it");
  }
  redacted.fields = importer.redact(redacted.bytes, input.name());
  for (PersonalField& field : redacted.fields) CleanText(field.text);
  Cross(answer, redacted);
}

void ReadTableTrials(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  TableMapping mapping;
  Cross(arguments, mapping);
  std::vector<TableTrial> trials =
      ListTableTrials(*OpenStream(input.path()), input.name(), mapping);
  Cross(answer, trials);
}

}  // namespace

std::vector<FencedReader> MakeRecordingReaders() {
  return {{"recording", &ReadRecording},
          {"redacted_recording", &ReadRedacted},
          {"table_trials", &ReadTableTrials}};
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
