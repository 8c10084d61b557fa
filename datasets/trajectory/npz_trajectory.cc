#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/version.h"
#include "datasets/session/find_trial.h"
#include "datasets/trajectory/trajectory_arrays.h"

namespace graspbench {
namespace {

/** NumPy's file of one array, version 1.0: magic, length of the header, header, values.
Source: numpy.lib.format. */
std::string MakeNpy(const std::string& type, const std::string& shape, std::string_view values) {
  constexpr size_t kAlignment = 64, kPrefix = 10;
  std::string header =
      "{'descr': " + type + ", 'fortran_order': False, 'shape': (" + shape + "), }";
  header.resize((kPrefix + header.size() + kAlignment) / kAlignment * kAlignment - kPrefix, ' ');
  header.back() = '\n';
  const size_t size = header.size();
  std::string bytes = "\x93NUMPY\x01";
  for (const size_t byte : {size_t{0}, size % 256, size / 256}) bytes += static_cast<char>(byte);
  return bytes + header + std::string(values);
}

std::string MakeNpy(const TrajectoryArray& array) {
  const size_t num_columns = array.columns.size(), num_rows = array.values.size() / num_columns;
  return MakeNpy(
      "'<f8'", std::to_string(num_rows) + ", " + std::to_string(num_columns),
      {reinterpret_cast<const char*>(array.values.data()), array.values.size() * sizeof(double)});
}

/** Texts as bytes in UTF-8, filled up with zeros. */
std::string MakeNpy(const std::vector<std::string>& texts) {
  size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  std::string values;
  for (std::string text : texts) {
    text.resize(size);
    values += text;
  }
  return MakeNpy("'|S" + std::to_string(size) + "'", std::to_string(texts.size()) + ",", values);
}

/** A ZIP archive in memory, its entries without time. */
class Zip {
 public:
  Zip() {
    Check(::archive_write_set_format_zip(out_.get()));
    Check(::archive_write_set_bytes_in_last_block(out_.get(), 1));
    Check(::archive_write_open(out_.get(), &bytes_, nullptr, &WritePiece, nullptr));
  }

  void Add(const std::string& name, const std::string& content) {
    ::archive_entry_clear(entry_.get());
    ::archive_entry_set_pathname(entry_.get(), name.c_str());
    ::archive_entry_set_size(entry_.get(), static_cast<la_int64_t>(content.size()));
    ::archive_entry_set_filetype(entry_.get(), AE_IFREG);
    ::archive_entry_set_perm(entry_.get(), 0644);
    ::archive_entry_set_mtime(entry_.get(), 0, 0);
    Check(::archive_write_header(out_.get(), entry_.get()));
    Check(::archive_write_data(out_.get(), content.data(), content.size()) < 0 ? ARCHIVE_FATAL
                                                                               : ARCHIVE_OK);
  }

  std::string Finish() {
    Check(::archive_write_close(out_.get()));
    return std::move(bytes_);
  }

 private:
  static la_ssize_t WritePiece(archive*, void* to, const void* bytes, size_t size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(bytes), size);
    return static_cast<la_ssize_t>(size);
  }

  void Check(int status) {
    if (status == ARCHIVE_OK) return;
    throw Error(ErrorKind::kEnvironment, "libarchive cannot write a ZIP archive: " +
                                             std::string(::archive_error_string(out_.get())));
  }

  std::string bytes_;
  std::unique_ptr<archive, int (*)(archive*)> out_{::archive_write_new(), &::archive_write_free};
  std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry_{::archive_entry_new(),
                                                                  &::archive_entry_free};
};

std::string FormatFacts(const TrialTrajectory& trajectory) {
  const TrialResult& result = trajectory.traced.result;
  return FormatJson(Json{{"program", "graspbench " + std::string(program_version())},
                         {"physics_version", kPhysicsVersion},
                         {"trial_id", trajectory.planned.id},
                         {"trial", NameTrial(trajectory.planned)},
                         {"hand", trajectory.planned.hand},
                         {"object", trajectory.planned.object},
                         {"grasp", trajectory.planned.grasp},
                         {"outcome", NameOf(result.outcome)},
                         {"reason", result.reason},
                         {"closure_start_s", trajectory.traced.closure_start},
                         {"rate_hz", trajectory.rate},
                         {"record_sha256", trajectory.record_sha256}});
}

std::vector<TrajectoryFile> MakeNpzFile(const TrialTrajectory& trajectory) {
  Zip zip;
  const auto add = [&](const std::string& name, const auto& array) {
    zip.Add(name + ".npy", MakeNpy(array));
  };
  for (const TrajectoryArray& array : MakeTrajectoryArrays(trajectory)) {
    add(array.name, array);
    add(array.name + "_columns", array.columns);
  }
  std::vector<std::string> links, digits, phases;
  for (const HandLink& link : trajectory.hand->links) links.push_back(link.name);
  for (const Digit& digit : trajectory.hand->digits) digits.push_back(digit.id);
  for (const TraceInstant& instant : trajectory.traced.trace) {
    phases.push_back(NameOf(instant.next_phase));
  }
  using Texts = std::vector<std::string>;
  add("links", links);
  add("digits", digits);
  add("phases", phases);
  add("events", Texts{FormatTrajectoryEvents(trajectory)});
  add("facts", Texts{FormatFacts(trajectory)});
  return {{".npz", zip.Finish()}};
}

}  // namespace

TrajectoryForm MakeNpzTrajectoryForm() {
  return {"npz", "a trial's arrays for NumPy, with the names of their columns", &MakeNpzFile,
          nullptr};
}

}  // namespace graspbench
