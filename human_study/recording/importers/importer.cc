#include "human_study/recording/importers/importer.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"

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

Recording LoadRecording(const fs::path& path, const ImportOptions& options) {
  const std::unique_ptr<std::istream> file = OpenStream(path);
  std::istream& stream = *file;
  // A mapping is only of use to the plain table.
  const std::string format =
      options.format.empty() && !options.mapping.empty() ? "table" : options.format;
  const Importer& importer = FindImporter(format, ReadHead(stream), path);
  const auto read_sibling = [&](const std::string& name) -> std::optional<std::string> {
    const fs::path sibling = path.parent_path() / name;
    std::error_code status;
    if (!fs::is_regular_file(sibling, status)) return std::nullopt;
    return ReadFile(sibling);
  };
  return ImportRecording(importer, {stream, path.string(), read_sibling}, options);
}

std::vector<PersonalField> RedactRecording(const fs::path& in, const fs::path& out) {
  std::string bytes = ReadFile(in);
  const Importer& importer = FindImporter("", std::string_view(bytes).substr(0, 4096), in);
  if (importer.redact == nullptr) {
    throw Error(ErrorKind::kUnsupported, in.string() + ": " + importer.title +
                                             " has no known places for personal data; look at the "
                                             "file yourself before sharing it");
  }
  std::vector<PersonalField> fields = importer.redact(bytes, in.string());
  for (PersonalField& field : fields) CleanText(field.text);
  WriteFileAtomically(out, bytes);
  return fields;
}

}  // namespace graspbench
