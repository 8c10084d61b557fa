#include "datasets/pipeline/pipeline_pack.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <memory>
#include <set>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/pipeline/stable_files.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr size_t kPiece = 1 << 16;  // [bytes]

/** Regular files below the folder, sorted. */
std::vector<std::string> ListFilesBelow(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** What libarchive writes to; no exception may pass through it. */
struct PackOutput {
  explicit PackOutput(const fs::path& path) : pack(path), file(path) {}
  const fs::path& pack;
  AtomicFile file;
  std::exception_ptr fault;
};

[[noreturn]] void FailToWrite(const PackOutput& output, archive* out) {
  if (output.fault) std::rethrow_exception(output.fault);
  const char* reason = ::archive_error_string(out);
  throw Error(ErrorKind::kIo, "cannot write \"" + output.pack.string() +
                                  "\": " + (reason ? reason : "unknown reason"));
}

struct WriterFree {
  void operator()(archive* out) const { ::archive_write_free(out); }
};
struct ReaderFree {
  void operator()(archive* in) const { ::archive_read_free(in); }
};
struct EntryFree {
  void operator()(archive_entry* entry) const { ::archive_entry_free(entry); }
};

la_ssize_t WritePiece(archive*, void* file, const void* bytes, size_t size) {
  PackOutput& output = *static_cast<PackOutput*>(file);
  try {
    output.file.Write({static_cast<const char*>(bytes), size});
    return static_cast<la_ssize_t>(size);
  } catch (...) {
    output.fault = std::current_exception();
    return -1;
  }
}

void AddFile(const fs::path& folder, const std::string& name, const PackOutput& output,
             archive* out) {
  const std::unique_ptr<archive_entry, EntryFree> entry(::archive_entry_new());
  ::archive_entry_set_pathname(entry.get(), name.c_str());
  ::archive_entry_set_size(entry.get(), static_cast<la_int64_t>(fs::file_size(folder / name)));
  ::archive_entry_set_filetype(entry.get(), AE_IFREG);
  ::archive_entry_set_perm(entry.get(), 0644);
  ::archive_entry_set_mtime(entry.get(), 0, 0);
  if (::archive_write_header(out, entry.get()) != ARCHIVE_OK) FailToWrite(output, out);
  ReadPieces(folder / name, [&](std::string_view piece) {
    if (::archive_write_data(out, piece.data(), piece.size()) < 0) FailToWrite(output, out);
    return true;
  });
}

[[noreturn]] void FailOnPack(const fs::path& pack, const std::string& text) {
  throw Error(ErrorKind::kFormat,
              "\"" + pack.string() + "\" " + text + "; expected a pack as graspbench wrote it");
}

bool IsSafeName(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && !path.is_absolute() && path.lexically_normal() == path &&
         *path.begin() != ".." && name.back() != '/' && name != ".";
}

void ExtractFile(const fs::path& pack, archive* in, const fs::path& target) {
  std::ofstream file(target, std::ios::binary);
  std::array<char, kPiece> piece;
  for (;;) {
    const la_ssize_t size = ::archive_read_data(in, piece.data(), piece.size());
    if (size < 0)
      FailOnPack(pack, "is cut off or damaged inside \"" + target.filename().string() + "\"");
    if (size == 0) break;
    file.write(piece.data(), size);
  }
  file.close();
  if (!file) throw Error(ErrorKind::kIo, "cannot write \"" + target.string() + "\"");
}

/** Behind its end a tar file may be filled up with zeros, no more. */
void CheckEnd(const fs::path& pack, archive* in) {
  ReadPieces(
      pack,
      [&](std::string_view piece) {
        if (piece.find_first_not_of('\0') != piece.npos) FailOnPack(pack, "goes on behind its end");
        return true;
      },
      static_cast<uintmax_t>(::archive_filter_bytes(in, 0)));
}

void ExtractAll(const fs::path& pack, archive* in, const fs::path& folder) {
  std::set<std::string> names;
  archive_entry* entry = nullptr;
  for (;;) {
    const int status = ::archive_read_next_header(in, &entry);
    if (status == ARCHIVE_EOF) break;
    if (status != ARCHIVE_OK) FailOnPack(pack, "is no tar file, or it is cut off or damaged");
    const char* text = ::archive_entry_pathname(entry);
    const std::string name = text ? text : "";
    if (!IsSafeName(name) || ::archive_entry_filetype(entry) != AE_IFREG ||
        ::archive_entry_hardlink(entry)) {
      FailOnPack(pack, "holds \"" + name + "\", which is no file below its own folder");
    }
    if (!names.insert(name).second) FailOnPack(pack, "holds \"" + name + "\" twice");
    std::error_code fault;
    fs::create_directories((folder / name).parent_path(), fault);
    if (fault || fs::exists(folder / name)) {
      FailOnPack(pack, "holds \"" + name + "\", whose name is a folder's or goes through a file");
    }
    ExtractFile(pack, in, folder / name);
  }
  CheckEnd(pack, in);
}

Manifest CheckUnpacked(const fs::path& pack, const fs::path& folder, const std::string& kind) {
  if (!HasManifest(folder)) FailOnPack(pack, "has no manifest.json");
  Manifest manifest;
  try {
    manifest = LoadManifest(folder);
  } catch (const Error&) {
    FailOnPack(pack, "has a manifest.json that is not as it was written");
  }
  if (manifest.kind != kind) {
    FailOnPack(pack, "is a pack of kind \"" + manifest.kind + "\" and not \"" + kind + "\"");
  }
  for (const ManifestFile& file : manifest.files) {
    if (!IsSafeName(file.path)) FailOnPack(pack, "names \"" + file.path + "\" in its manifest");
  }
  const std::vector<Damage> damages = FindDamage(folder, manifest);
  if (!damages.empty()) {
    throw Error(ErrorKind::kFormat, "\"" + pack.string() + "\" is damaged" + FormatDamage(damages));
  }
  std::set<std::string> known = {kManifestFile};
  for (const ManifestFile& file : manifest.files) known.insert(file.path);
  for (const std::string& file : ListFilesBelow(folder)) {
    if (known.count(file) == 0)
      FailOnPack(pack, "holds \"" + file + "\", which its manifest lacks");
  }
  return manifest;
}

/** A file or folder of the user's, links followed. */
void CopyInput(const fs::path& from, const fs::path& to) {
  if (fs::is_directory(from)) {
    CopyStableFiles(from, to);
  } else if (!fs::exists(to)) {  // as a file of a folder that is an input, too
    MakeFolder(to.parent_path());
    fs::copy_file(from, to);
  }
}

}  // namespace

void WritePack(const fs::path& folder, const fs::path& pack) {
  PackOutput output(pack);
  const std::unique_ptr<archive, WriterFree> out(::archive_write_new());
  if (::archive_write_set_format_pax_restricted(out.get()) != ARCHIVE_OK ||
      ::archive_write_set_bytes_in_last_block(out.get(), 1) != ARCHIVE_OK ||
      ::archive_write_open(out.get(), &output, nullptr, WritePiece, nullptr) != ARCHIVE_OK) {
    FailToWrite(output, out.get());
  }
  std::vector<std::string> names = ListFilesBelow(folder);
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name == kManifestFile; });
  for (const std::string& name : names) AddFile(folder, name, output, out.get());
  if (::archive_write_close(out.get()) != ARCHIVE_OK) FailToWrite(output, out.get());
  output.file.Commit();
}

void GatherPack(const Pipeline& pipeline, const fs::path& results, const ManifestOrigin& origin,
                const fs::path& folder) {
  try {
    const fs::path packed = folder / kPackedPipeline;
    MakeFolder(packed);
    const std::string name = pipeline.file.filename().string();
    fs::copy_file(pipeline.file, packed / name);
    std::set<std::string> inputs;
    for (const PipelineStage& stage : pipeline.stages) {
      for (const StageInput& input : stage.inputs) {
        if (input.stage.empty()) inputs.insert(input.path);
      }
    }
    for (const std::string& input : inputs) {
      const bool is_inside =
          std::any_of(inputs.begin(), inputs.end(), [&](const std::string& outer) {
            return input.size() > outer.size() && input.compare(0, outer.size(), outer) == 0 &&
                   input[outer.size()] == '/';
          });
      if (!is_inside) CopyInput(fs::path(pipeline.folder) / input, packed / input);
    }
    for (const PipelineStage& stage : pipeline.stages) {
      CopyStableFiles(results / stage.name, folder / kPackedResults / stage.name);
    }
    const std::string file = std::string(kPackedPipeline) + "/" + name;
    ManifestOrigin made = origin;
    made.inputs = {{file, SealFile(folder, file).sha256}};
    SealPack(folder, kPipelinePack, made);
  } catch (const fs::filesystem_error& fault) {
    throw Error(ErrorKind::kIo, std::string("cannot gather the pack: ") + fault.what());
  }
}

void SealPack(const fs::path& folder, const std::string& kind, const ManifestOrigin& origin) {
  Manifest manifest;
  manifest.kind = kind;
  manifest.versions = origin.versions;
  manifest.origin = origin;
  for (const std::string& path : ListFilesBelow(folder)) {
    manifest.files.push_back(SealFile(folder, path));
  }
  WriteManifest(folder, manifest);
}

Manifest Unpack(const fs::path& pack, const fs::path& folder, const std::string& kind) {
  std::error_code fault;
  if (!fs::is_regular_file(pack, fault)) {
    throw Error(ErrorKind::kNotFound, "no file \"" + pack.string() + "\"");
  }
  const std::unique_ptr<archive, ReaderFree> in(::archive_read_new());
  ::archive_read_support_format_tar(in.get());
  if (::archive_read_open_filename(in.get(), pack.c_str(), kPiece) != ARCHIVE_OK) {
    FailOnPack(pack, "is no tar file");
  }
  MakeFolder(folder);
  ExtractAll(pack, in.get(), folder);
  return CheckUnpacked(pack, folder, kind);
}

fs::path FindPackedFile(const fs::path& folder, const Manifest& manifest) {
  const std::string prefix = std::string(kPackedPipeline) + "/";
  if (manifest.origin && manifest.origin->inputs.size() == 1) {
    const std::string& name = manifest.origin->inputs.front().path;
    if (manifest.Find(name) && name.compare(0, prefix.size(), prefix) == 0) return folder / name;
  }
  throw Error(ErrorKind::kFormat, "the pack's manifest does not say which file is its pipeline");
}

}  // namespace graspbench
