#pragma once
/** @file
Foreign files are read in a process of their own, so that a damaged or malicious one can neither
crash, stop nor fill the program that asks.

The program graspbench-reader (workbench/reader.cc) waits for files, reads one after the other and
hands back what each holds (serve_fence.h). The parent opens every file and sends it as an open
file; a file beside it that the reader asks for (a buffer of a glTF, the channels of Motion-BIDS) is
opened by the parent too, if its rule allows it. Each thread that reads at the same time has a
reader of its own; a reader is started at its first file (4 ms of a processor)
and stays (0.2 ms a file).

Limits, for each file:
    memory     1 GB and four times the file's size: refused with kFormat, the same everywhere
    time       of the processor, kReaderSeconds unless the reader needs more: kEnvironment, which
               nobody stores, since another machine would have read it
    output     4 GB
A reader that ends by a signal refuses the file (kFormat). It opens nothing for writing: the kernel
refuses that (where it has seccomp filters). */

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fence/crossing.h"

namespace graspbench {

inline constexpr int kReaderSeconds = 20;                     // of processor time, for one file
inline constexpr uint64_t kReaderMemory = uint64_t{1} << 30;  // beside kReaderMemoryPerByte
inline constexpr uint64_t kReaderMemoryPerByte = 4;           // of the file

/** A file that is open for reading: on the disk, or in memory. */
class FencedFile {
 public:
  /** A regular file. @throws Error(kNotFound, kIo). */
  explicit FencedFile(const std::filesystem::path& path);
  /** The bytes, and their name for messages. @throws Error(kEnvironment) without memory. */
  FencedFile(std::string_view bytes, std::string name);
  ~FencedFile();
  FencedFile(const FencedFile&) = delete;
  FencedFile& operator=(const FencedFile&) = delete;

  int id() const { return id_; }
  const std::string& name() const { return name_; }

 private:
  int id_ = -1;
  std::string name_;
};

/** Where a file lies that another one names; nothing: it is not there, or may not be read. */
using FindBeside = std::function<std::optional<std::filesystem::path>(const std::string& name)>;

/** What a reader handed back, in memory of the kernel. Each byte is copied once, so that it is of no
use to change it later, and its memory is given back at once. */
class FencedAnswer {
 public:
  explicit FencedAnswer(std::unique_ptr<FencedFile> file);
  /** All that is left of it, which this outlives. */
  IncomingValues values();

 private:
  void Take(char* data, size_t size);
  void Fetch(char* data, size_t size);

  std::unique_ptr<FencedFile> file_;
  size_t size_ = 0, num_fetched_ = 0;
  std::string piece_;  ///< fetched for small values
  size_t num_taken_ = 0;
};

/** Readers of one program. Safe with threads. */
class Fence {
 public:
  explicit Fence(std::filesystem::path program);
  ~Fence();
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /** That of graspbench-reader. @throws Error(kEnvironment) where the program is missing. */
  static Fence& Shared();

  /** What the reader of that name makes of the file.
  @throws the reader's own Error; Error(kFormat, kEnvironment) as above. */
  template <class Result, class... Arguments>
  Result Read(const char* reader, const FencedFile& file, const FindBeside& find_beside,
              int seconds, Arguments... arguments) {
    OutgoingValues sent;
    Cross(sent, arguments...);
    const std::unique_ptr<FencedAnswer> answer =
        Run(reader, file, find_beside, seconds, sent.bytes());
    IncomingValues values = answer->values();
    Result result;
    Cross(values, result);
    return result;
  }

 private:
  struct Reader;
  std::unique_ptr<FencedAnswer> Run(const std::string& reader, const FencedFile& file,
                                    const FindBeside& find_beside, int seconds,
                                    const std::string& arguments);
  std::unique_ptr<Reader> Start() const;

  std::filesystem::path program_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Reader>> idle_;
};

}  // namespace graspbench
