#pragma once
/** @file
The other side of the fence (fence.h): the loop of graspbench-reader, and how it talks.

Standard input is a socket of whole messages. A request carries three open files: what is asked (the
reader's name, the file's name, its time, its arguments), the file, and one for the answer. The
reader may ask for a file beside it (kAskBeside and the name, answered with kBeside and the open
file, or without one). kDone ends a request: the answer is one byte, kIsRead and the result, or
kIsRefused, the kind of an Error and its message. */

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/fence/crossing.h"

namespace graspbench {

enum FenceMessage : char { kRequest = 'R', kAskBeside = 'A', kBeside = 'B', kDone = 'D' };
enum FenceStatus : char { kIsRead = 0, kIsRefused = 1 };
/** Exit codes: the socket was closed; memory lacked where nothing may be thrown, or for a sanitizer;
a sanitizer found a fault. */
enum FenceExit : int { kFenceClosed = 0, kFenceNoMemory = 98, kFenceFault = 99 };
inline constexpr size_t kMaxFenceMessage = 4096;
inline constexpr size_t kMaxFenceFiles = 3;

/** A message and the files that came with it, which belong to who takes it. */
struct FencePacket {
  std::string text;
  std::vector<int> files;
};
/** False: the other side is gone. */
bool SendFencePacket(int socket, std::string_view text, const std::vector<int>& files);
std::optional<FencePacket> ReceiveFencePacket(int socket);

/** The file that a reader is to read. */
class FencedInput {
 public:
  FencedInput(int file, std::string name) : file_(file), name_(std::move(name)) {}

  /** For messages. */
  const std::string& name() const { return name_; }
  /** Opens it again, for OpenStream and ReadFile. */
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }
  /** Content of a file beside it; nothing where the parent gives none. */
  std::optional<std::string> ReadBeside(const std::string& name) const;

 private:
  int file_;
  std::string name_;
};

struct FencedReader {
  const char* id;
  /** Takes the arguments and hands over the result. @throws Error. */
  std::function<void(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer)>
      read;
};

/** Reads until the parent closes the socket. @returns the exit code of the process. */
int ServeFence(const std::vector<FencedReader>& readers);

}  // namespace graspbench
