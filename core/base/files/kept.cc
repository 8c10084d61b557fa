#include "core/base/files/kept.h"

#include <cstring>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

// Precedes the content.
struct KeptHeader {
  char kind[kKeptKindSize];
  uint64_t hash;  // of the key and the content, which follow
  uint64_t key;
};
static_assert(sizeof(KeptHeader) == 24);
constexpr size_t kHashedFrom = 16;

}  // namespace

std::optional<std::string> ReadKept(const fs::path& path, std::string_view kind, uint64_t key) {
  GRASPBENCH_DEMAND(kind.size() == kKeptKindSize, std::string(kind));
  std::error_code status;
  if (!IsPrivateFolder(path.parent_path()) ||
      !fs::is_regular_file(fs::symlink_status(path, status))) {
    return std::nullopt;
  }
  try {
    std::string bytes = ReadFile(path);
    KeptHeader header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::string_view(header.kind, kKeptKindSize) != kind || header.key != key ||
        header.hash != CalcHash64(std::string_view(bytes).substr(kHashedFrom))) {
      return std::nullopt;
    }
    bytes.erase(0, sizeof header);
    return bytes;
  } catch (const Error&) {
    return std::nullopt;  // an unreadable file counts as absent
  }
}

void Keep(const fs::path& path, std::string_view kind, uint64_t key, std::string_view content) {
  GRASPBENCH_DEMAND(kind.size() == kKeptKindSize, std::string(kind));
  KeptHeader header = {};
  std::memcpy(header.kind, kind.data(), kKeptKindSize);
  header.key = key;
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes += content;
  header.hash = CalcHash64(std::string_view(bytes).substr(kHashedFrom));
  std::memcpy(bytes.data(), &header, sizeof header);
  try {
    MakePrivateFolder(path.parent_path());
    // Not synced to the disk: the hash reveals a file that a power failure damaged.
    WriteFile(path, bytes);
  } catch (const Error&) {
    std::error_code status;
    fs::remove(path, status);  // the disk may be full: remove the partial file
  }
}

}  // namespace graspbench
